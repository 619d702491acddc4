#include "candela/image_format.h"

#include <span>
#include <stdexcept>

namespace candela {

ByteSink::~ByteSink() = default;
ImageSink::~ImageSink() = default;

std::span<float> ImageSink::allocate_opacity() { return {}; }
ImageFormat::~ImageFormat() = default;

void ImageFormat::write_layers(int, int, std::span<const ImageChannel>, const char*, ByteSink&) const {
    throw std::runtime_error("this plugin writes no layers");
}

void ImageFormat::read(const char*, ImageSink&) const {
    throw std::runtime_error("this plugin writes pictures and reads none");
}

}  // namespace candela
