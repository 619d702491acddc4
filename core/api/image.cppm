module;

#include "candela/image_format.h"

export module candela.image;

export import candela.descriptor;
export import candela.math;

export namespace candela {
using candela::ByteSink;
using candela::ImageFormat;
using candela::PictureChannel;
using candela::PictureSink;
using candela::PictureView;
}  // namespace candela
