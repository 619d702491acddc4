// Between copying the picture and encoding it, another thread may overwrite the copy.
#include <algorithm>
#include <array>

#include "faulty_image.h"

namespace {
std::array<std::uint8_t, 65536> scratch;
class SharesItsScratch final : public faulty::Runs {
    using Runs::Runs;
    void write(const candela::PictureView& picture, const char* extension,
               candela::ByteSink& sink) const override {
        if (picture.bytes.size() > scratch.size()) return Runs::write(picture, extension, sink);
        std::ranges::copy(picture.bytes, scratch.begin());
        candela::PictureView copy = picture;
        copy.bytes = std::span(scratch).first(picture.bytes.size());
        Runs::write(copy, extension, sink);
    }
};
}  // namespace

FAULTY_RUNS(SharesItsScratch)
