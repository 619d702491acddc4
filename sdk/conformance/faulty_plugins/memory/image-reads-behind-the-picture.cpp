// Reads one past the last pixel without using the value.
#include "faulty_reflection.h"

namespace {
class ReadsBehindThePicture final : public faulty::Ppm {
    using Ppm::Ppm;
    void write(const candela::PictureView& picture, const char* extension,
               candela::ByteSink& sink) const override {
        Ppm::write(picture, extension, sink);
        [[maybe_unused]] const volatile std::uint8_t next = *(picture.bytes.data() + picture.bytes.size());
    }
};
}  // namespace

FAULTY_FORMAT(ReadsBehindThePicture)
