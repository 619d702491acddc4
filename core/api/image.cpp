#include "candela/image.h"

#include <stdexcept>

namespace candela {

ByteSink::~ByteSink() = default;
PictureSink::~PictureSink() = default;
ImageFormat::~ImageFormat() = default;

void ImageFormat::read(const char*, PictureSink&) const {
    throw std::runtime_error("this plugin writes pictures and reads none");
}

}  // namespace candela
