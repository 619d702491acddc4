// Reads one past the last pixel without using the value.
#include "faulty_reflection.h"

namespace {
class ReadsBehindTheImage final : public faulty::Ppm {
    using Ppm::Ppm;
    void write(const candela::ImageView& image, const char* extension,
               candela::ByteSink& sink) const override {
        Ppm::write(image, extension, sink);
        [[maybe_unused]] const volatile std::uint8_t next = *(image.bytes.data() + image.bytes.size());
    }
};
}  // namespace

FAULTY_FORMAT(ReadsBehindTheImage)
