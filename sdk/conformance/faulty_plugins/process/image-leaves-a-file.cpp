// A PPM writer that leaves its own file in the working directory.
#include "faulty_reflection.h"

namespace {
class LeavesAFile final : public faulty::Ppm {
    using Ppm::Ppm;
    void write(const candela::ImageView& image, const char* extension,
               candela::ByteSink& sink) const override {
        std::ofstream("picture.tmp") << "half a picture";
        Ppm::write(image, extension, sink);
    }
};
}  // namespace

FAULTY_FORMAT(LeavesAFile)
