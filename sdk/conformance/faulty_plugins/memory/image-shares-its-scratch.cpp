// Between copying the picture and encoding it, another thread may overwrite the copy.
#include <algorithm>
#include <array>

#include "faulty_image.h"

namespace {
std::array<std::uint8_t, 65536> scratch;
class SharesItsScratch final : public faulty::Runs {
    using Runs::Runs;
    void write(const candela::ImageView& image, const char* extension,
               candela::ByteSink& sink) const override {
        if (image.bytes.size() > scratch.size()) return Runs::write(image, extension, sink);
        std::ranges::copy(image.bytes, scratch.begin());
        candela::ImageView copy = image;
        copy.bytes = std::span(scratch).first(image.bytes.size());
        Runs::write(copy, extension, sink);
    }
};
}  // namespace

FAULTY_RUNS(SharesItsScratch)
