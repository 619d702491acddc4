module;

#include "candela/color.h"

export module candela.color;

export namespace candela {
using candela::Rgb;
using candela::operator+;
using candela::operator*;
using candela::ColorEncoding;
using candela::decoded;
using candela::linear_to_srgb;
using candela::PixelType;
using candela::srgb_to_linear;
}  // namespace candela
