#include "aov/luminance.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <string_view>
#include <system_error>
#include <vector>

#include "compare/sheet_label.h"

import candela.api;
import candela.util;

using candela::Error;
using candela::ErrorCategory;
using candela::Film;
using candela::Rgb;

namespace {

constexpr Rgb k_paper{1, 1, 1}, k_ink{0, 0, 0};

/// viridis (Smith and van der Walt 2015, CC0) at ten equidistant positions: its lightness grows uniformly,
/// also for people who do not see all hues, and on paper.
constexpr std::array<std::array<int, 3>, 10> k_viridis{{{68, 1, 84},
                                                        {72, 40, 120},
                                                        {62, 74, 137},
                                                        {49, 104, 142},
                                                        {38, 130, 142},
                                                        {31, 158, 137},
                                                        {53, 183, 121},
                                                        {109, 205, 89},
                                                        {180, 222, 44},
                                                        {253, 231, 37}}};

double position_on(const LuminanceScale& scale, double luminance) {
    return std::log(luminance / scale.low) / std::log(scale.high / scale.low);
}

/// The marks of a legend: its ends, then powers of ten, then 2 and 5 times these.
std::vector<double> possible_marks(const LuminanceScale& scale) {
    std::vector<double> marks{scale.low, scale.high};
    const int first = static_cast<int>(std::floor(std::log10(scale.low)));
    const int last = static_cast<int>(std::ceil(std::log10(scale.high)));
    for (const double digit : {1.0, 2.0, 5.0}) {
        for (int power = first; power <= last; ++power) {
            const double mark = digit * std::pow(10.0, power);
            if (mark > scale.low && mark < scale.high) marks.push_back(mark);
        }
    }
    return marks;
}

struct Mark {
    int y;
    std::string text;
};

}  // namespace

LuminanceScale luminance_scale_from(const std::string& text, const std::string& origin) {
    LuminanceScale scale;
    const char* const end = text.data() + text.size();
    const auto low = std::from_chars(text.data(), end, scale.low);
    const bool has_low = low.ec == std::errc{} && low.ptr != end && *low.ptr == ',';
    const auto high = has_low ? std::from_chars(low.ptr + 1, end, scale.high) : low;
    // Within single precision.
    constexpr double k_least = 1e-30, k_most = 1e30;
    const bool is_scale = has_low && high.ec == std::errc{} && high.ptr == end && scale.low >= k_least &&
                          scale.high <= k_most && scale.high > scale.low;
    if (!is_scale) {
        throw Error(ErrorCategory::bad_request,
                    fmt::format("{} is '{}'; expected two luminances above 0 in cd/m², the smaller first, "
                                "as in {} 0.1,1000",
                                origin, candela::printable(text), origin));
    }
    return scale;
}

LuminanceScale scale_for(const Film& luminance) {
    double least = std::numeric_limits<double>::max(), most = 0;
    const std::span<const float> values = luminance.view().reals;
    for (std::size_t i = 0; i < values.size(); i += 3) {
        if (!(values[i] > 0) || !std::isfinite(values[i])) continue;
        least = std::min(least, double{values[i]});
        most = std::max(most, double{values[i]});
    }
    if (most == 0) return {};
    constexpr double k_most_decades = 4;
    constexpr double k_rounding = 1e-6;
    const double high = std::ceil(std::log10(most) - k_rounding);
    const double low =
        std::clamp(std::floor(std::log10(least) + k_rounding), high - k_most_decades, high - 1);
    return {std::pow(10, low), std::pow(10, high)};
}

Rgb false_color(double t) {
    const double at = std::clamp(t, 0.0, 1.0) * (k_viridis.size() - 1);
    const std::size_t before = std::min(static_cast<std::size_t>(at), k_viridis.size() - 2);
    const double share = at - static_cast<double>(before);
    const auto channel = [&](std::size_t c) {
        return static_cast<float>(
            std::lerp(k_viridis[before][c], static_cast<double>(k_viridis[before + 1][c]), share) / 255);
    };
    return {channel(0), channel(1), channel(2)};
}

Film in_false_colors(const Film& luminance, const LuminanceScale& scale) {
    const int width = luminance.width();
    Film film(width, luminance.height(), candela::PixelType::byte, candela::ColorEncoding::none);
    const std::span<const float> values = luminance.view().reals;
    const auto columns = static_cast<std::size_t>(width);
    std::vector<float> r(columns), g(columns), b(columns);
    for (int y = 0; y < luminance.height(); ++y) {
        for (std::size_t x = 0; x < columns; ++x) {
            const float value = values[3 * (static_cast<std::size_t>(y) * columns + x)];
            const Rgb color = value > 0 ? false_color(position_on(scale, double{value})) : Rgb{};
            r[x] = color.r;
            g[x] = color.g;
            b[x] = color.b;
        }
        film.store(0, y, width, 1, {r.data(), g.data(), b.data()}, width);
    }
    return film;
}

Film with_legend(const Film& picture, const LuminanceScale& scale) {
    constexpr int k_margin = 4, k_bar = 12, k_tick = 3, k_gap = 2;  // times the letters' scale
    const int letters = std::max(1, (std::min(picture.width(), picture.height()) + 250) / 500);
    const std::string unit = "cd/m";
    const LabelSize unit_size = label_size(unit, letters);
    const int line = unit_size.height, raised = line / 4;
    const int margin = k_margin * letters;
    const int height = std::max(picture.height(), 6 * line);
    // Numbers at the bar's ends are half a line higher and lower than it.
    const int top = margin + raised + line + line / 2, bottom = height - margin - line / 2;
    std::vector<Mark> marks;
    int widest = 0;
    for (const double mark : possible_marks(scale)) {
        const int y = bottom - static_cast<int>(std::lround(position_on(scale, mark) * (bottom - top)));
        if (std::ranges::any_of(marks, [&](const Mark& other) { return std::abs(other.y - y) < line; }))
            continue;
        marks.push_back({y, fmt::format("{:g}", mark)});
        widest = std::max(widest, label_size(marks.back().text, letters).width);
    }
    const int left = picture.width() + margin;
    const int right = left + k_bar * letters;
    const int text = right + (k_tick + k_gap) * letters;
    const int end = std::max(text + widest, left + unit_size.width + label_size("2", letters).width) + margin;

    const candela::ColorEncoding encoding = picture.view().encoding;
    Film film(end, height, candela::PixelType::byte, encoding);
    film.fill(0, 0, film.width(), film.height(), k_paper);
    film.paste(0, 0, picture);
    draw_label(film, left, margin + raised, letters, unit, k_ink);
    draw_label(film, left + unit_size.width, margin, letters, "2", k_ink);
    for (int y = top; y <= bottom; ++y) {
        const double t = static_cast<double>(bottom - y) / (bottom - top);
        const Rgb color = false_color(t);
        film.fill(left, y, right - left, 1,
                  encoding == candela::ColorEncoding::srgb
                      ? Rgb{candela::srgb_to_linear(color.r), candela::srgb_to_linear(color.g),
                            candela::srgb_to_linear(color.b)}
                      : color);
    }
    for (const Mark& mark : marks) {
        film.fill(right, mark.y - (letters - 1) / 2, k_tick * letters, letters, k_ink);
        // The middle of a digit is four units below the top of its line.
        draw_label(film, text, mark.y - 4 * letters, letters, mark.text, k_ink);
    }
    return film;
}
