#include "compare/sheet_label.h"

#include <stb/stb_easy_font.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

import candela.util;

namespace {

constexpr int k_line_height = 10;  // letters and their descenders

/// The text in the font's character set.
std::string in_ascii(const std::string& text) {
    std::string ascii;
    for (std::size_t at = 0; at < text.size();) {
        const std::string_view character = candela::first_character(std::string_view(text).substr(at));
        const bool is_known = character.size() == 1 && character[0] >= ' ' && character[0] < '\x7f';
        ascii += is_known ? character[0] : '?';
        at += std::max<std::size_t>(character.size(), 1);
    }
    return ascii;
}

/// As filled in by the font's functions.
struct Vertex {
    float x, y, z;
    std::array<unsigned char, 4> color;
};

}  // namespace

LabelSize label_size(const std::string& text, int scale) {
    std::string ascii = in_ascii(text);
    return {scale * stb_easy_font_width(ascii.data()), scale * k_line_height};
}

void draw_label(candela::Film& film, int x, int y, int scale, const std::string& text,
                candela::Rgb intensity) {
    std::string ascii = in_ascii(text);
    constexpr std::size_t k_most_quads = 20;  // per character
    std::vector<Vertex> vertices(4 * k_most_quads * (ascii.size() + 1));
    const int quads = stb_easy_font_print(0, 0, ascii.data(), nullptr, vertices.data(),
                                          static_cast<int>(vertices.size() * sizeof(Vertex)));
    for (std::size_t quad = 0; quad < static_cast<std::size_t>(quads); ++quad) {
        const Vertex &first = vertices[4 * quad], &opposite = vertices[4 * quad + 2];
        const auto edge = [&](float at, int from, int end) {
            return std::clamp(from + scale * static_cast<int>(std::lround(at)), 0, end);
        };
        const int left = edge(first.x, x, film.width()), right = edge(opposite.x, x, film.width()),
                  top = edge(first.y, y, film.height()), bottom = edge(opposite.y, y, film.height());
        if (right > left && bottom > top) film.fill(left, top, right - left, bottom - top, intensity);
    }
}

std::string fitted_label(const std::string& text, int scale, int width) {
    if (label_size(text, scale).width <= width) return text;
    std::string shorter = in_ascii(text);
    while (!shorter.empty() && label_size(shorter + "...", scale).width > width) shorter.pop_back();
    return shorter.empty() ? "" : shorter + "...";
}
