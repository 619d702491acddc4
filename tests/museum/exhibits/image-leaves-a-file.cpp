// A PPM writer that puts a file of its own where the command runs.
#include "museum.h"

namespace {
class LeavesAFile final : public museum::Ppm {
    using Ppm::Ppm;
    void write(const candela::PictureView& picture, const char* extension,
               candela::ByteSink& sink) const override {
        std::ofstream("picture.tmp") << "half a picture";
        Ppm::write(picture, extension, sink);
    }
};
}  // namespace

MUSEUM_FORMAT(LeavesAFile)
