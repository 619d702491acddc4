#include "candela/scanline_image.h"

#include <algorithm>
#include <cstddef>

namespace candela {

ImageRows::~ImageRows() = default;
RandomAccessSink::~RandomAccessSink() = default;
ScanlineImageFormat::~ScanlineImageFormat() = default;

ViewedRows::ViewedRows(const ImageView& image) : image_(image) {}
ViewedRows::~ViewedRows() = default;

ImageView ViewedRows::next(int count) {
    ImageView rows = image_;
    rows.height = std::min(count, image_.height - done_);
    const std::size_t row = 3 * static_cast<std::size_t>(image_.width);
    const std::size_t first = row * static_cast<std::size_t>(done_);
    const std::size_t size = row * static_cast<std::size_t>(rows.height);
    if (image_.pixels == PixelType::byte) {
        rows.bytes = image_.bytes.subspan(first, size);
    } else {
        rows.reals = image_.reals.subspan(first, size);
    }
    done_ += rows.height;
    return rows;
}

}  // namespace candela
