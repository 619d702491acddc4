// Several pictures of one size on one sheet, each with a label below it.
#pragma once

#include <string>

import candela.api;
import candela.render;

class ContactSheet {
  public:
    struct Layout {
        int columns, rows;
        int width, height;  // of each picture, in pixels
    };

    /// Throws candela::Error if the sheet would exceed the largest picture or the memory.
    ContactSheet(const Layout& layout, candela::PixelType pixels, candela::ColorEncoding encoding);

    /// `number` counts row by row from the top. The picture's pixels are copied unchanged.
    void put(int number, const candela::Film& image, const std::string& label);

    const candela::Film& film() const noexcept { return film_; }

  private:
    Layout layout_;
    int scale_;  // of the lettering
    candela::Film film_;
};
