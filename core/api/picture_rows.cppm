module;

#include "candela/scanline_image.h"

export module candela.picture_rows;

export import candela.image;

export namespace candela {
using candela::PictureRows;
using candela::RandomAccessSink;
using candela::RowFormat;
using candela::ViewedRows;
}  // namespace candela
