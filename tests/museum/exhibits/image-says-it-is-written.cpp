// A PPM writer that does not report failed writes.
#include "museum.h"

namespace {
class SaysItIsWritten final : public museum::Ppm {
    using Ppm::Ppm;
    void write(const candela::PictureView& picture, const char* extension,
               candela::ByteSink& sink) const override {
        try {
            Ppm::write(picture, extension, sink);
        } catch (...) {  // nobody will notice
        }
    }
};
}  // namespace

MUSEUM_FORMAT(SaysItIsWritten)
