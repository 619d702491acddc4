#include "compare/contact_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "compare/sheet_label.h"

import candela.api;
import candela.util;

using candela::Error;
using candela::ErrorCategory;

namespace {

constexpr candela::Rgb k_paper{0.8f, 0.8f, 0.8f}, k_ink{0.01f, 0.01f, 0.01f};
constexpr int k_margin = 4;  // times the letters' scale
constexpr int k_line = 10;

/// 1 for pictures up to 500 pixels wide, and so on.
int scale_for(int width) { return std::max(1, (width + 250) / 500); }

candela::Film blank(const ContactSheet::Layout& layout, int scale, candela::PixelType pixels,
                    candela::ColorEncoding encoding) {
    constexpr std::int64_t k_longest = 65536;
    const std::int64_t margin = std::int64_t{k_margin} * scale;
    const std::int64_t width = layout.columns * (layout.width + margin) + margin;
    const std::int64_t height =
        layout.rows * (layout.height + 2 * margin + std::int64_t{k_line} * scale) + margin;
    if (std::max(width, height) > k_longest) {
        throw Error(
            ErrorCategory::bad_request,
            fmt::format("the sheet would have {} x {} pixels; the maximum is {}: make its pictures smaller",
                        width, height, k_longest));
    }
    candela::Film film(static_cast<int>(width), static_cast<int>(height), pixels, encoding);
    film.fill(0, 0, film.width(), film.height(), k_paper);
    return film;
}

}  // namespace

ContactSheet::ContactSheet(const Layout& layout, candela::PixelType pixels, candela::ColorEncoding encoding)
    : layout_(layout), scale_(scale_for(layout.width)), film_(blank(layout, scale_, pixels, encoding)) {}

void ContactSheet::put(int number, const candela::Film& image, const std::string& label) {
    const int margin = k_margin * scale_;
    const int x = margin + number % layout_.columns * (layout_.width + margin);
    const int y = margin + number / layout_.columns * (layout_.height + 2 * margin + k_line * scale_);
    film_.paste(x, y, image);
    draw_label(film_, x, y + layout_.height + margin, scale_, fitted_label(label, scale_, layout_.width),
               k_ink);
}
