// Text in a picture.
#pragma once

#include <string>

import candela.api;
import candela.render;

/// The size of one line of text in pixels, with letters `scale` times as large as the font's.
struct LabelSize {
    int width, height;
};
LabelSize label_size(const std::string& text, int scale);

/// Draws a line of text with its upper left corner at (x, y), clipped to the film. Characters beyond ASCII,
/// which the font lacks, become question marks.
void draw_label(candela::Film& film, int x, int y, int scale, const std::string& text,
                candela::Rgb intensity);

/// The text, or the part of it that fits into `width` pixels, with an ellipsis.
std::string fitted_label(const std::string& text, int scale, int width);
