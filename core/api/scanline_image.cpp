#include "candela/scanline_image.h"

#include <algorithm>
#include <cstddef>

namespace candela {

PictureRows::~PictureRows() = default;
RandomAccessSink::~RandomAccessSink() = default;
ScanlineImageFormat::~ScanlineImageFormat() = default;

ViewedRows::ViewedRows(const PictureView& picture) : picture_(picture) {}
ViewedRows::~ViewedRows() = default;

PictureView ViewedRows::next(int count) {
    PictureView rows = picture_;
    rows.height = std::min(count, picture_.height - done_);
    const std::size_t row = 3 * static_cast<std::size_t>(picture_.width);
    const std::size_t first = row * static_cast<std::size_t>(done_);
    const std::size_t size = row * static_cast<std::size_t>(rows.height);
    if (picture_.pixels == PixelType::byte) {
        rows.bytes = picture_.bytes.subspan(first, size);
    } else {
        rows.reals = picture_.reals.subspan(first, size);
    }
    done_ += rows.height;
    return rows;
}

}  // namespace candela
