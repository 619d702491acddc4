// PNG's filters, applied to a row before it is compressed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

/// Bytes of a pixel: red, green, blue.
inline constexpr std::size_t k_pixel = 3;

/// Writes a row as in the file, one byte longer: the filter's number, then the row minus the pixels to the
/// left of it or above, whichever leaves more zeros. `above`: a row of the same length; null for the first
/// row.
void filter_row(std::span<const std::uint8_t> row, const std::uint8_t* above, std::uint8_t* result);
