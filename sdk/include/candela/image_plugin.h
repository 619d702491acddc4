// An image-format plugin: a class derived from candela::ImageFormat whose constructor takes its parameters
// (usually candela::sdk::NoParams), and
//
//     CANDELA_PLUGIN(image, MyFormat, candela::sdk::k_no_fields, {.title = …, .formats = k_formats})
#pragma once

#include <cstdint>
#include <stdexcept>

#include "candela/image_format.h"
#include "candela/plugin.h"
#include "candela/scanline_image.h"

namespace candela::sdk {

/// For readers of formats with a bounded compression ratio: refuses a file of a few bytes that claims a
/// hundred million pixels before memory is allocated for them. `pixels_per_byte`: the highest possible ratio.
/// Throws std::runtime_error.
inline void require_plausible(std::uintmax_t pixels, std::uintmax_t file_size,
                              std::uintmax_t pixels_per_byte) {
    if (pixels > pixels_per_byte * file_size)
        throw std::runtime_error("it is too small for its pixels: it is truncated, or its header is wrong");
}

}  // namespace candela::sdk
