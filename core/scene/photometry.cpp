module;

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>
#include <system_error>

module candela.scene;

import :photometry;
import candela.api;

namespace candela {

std::optional<Photometric> photometric_from(std::string_view text) {
    const auto skip_spaces = [&] { text.remove_prefix(std::min(text.find_first_not_of(' '), text.size())); };
    skip_spaces();
    if (text.starts_with('+')) text.remove_prefix(1);
    Photometric result;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), result.value);
    if (problem != std::errc() || !std::isfinite(result.value)) return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    skip_spaces();
    while (text.ends_with(' ')) text.remove_suffix(1);
    for (const std::string_view unit : {"lm", "cd", "W", "lx"}) {
        if (!text.ends_with(unit)) continue;
        const std::string_view prefix = text.substr(0, text.size() - unit.size());
        constexpr std::array<std::string_view, 4> k_prefixes{"", "m", "k", "M"};
        constexpr std::array<double, 4> k_factors{1, 1e-3, 1e3, 1e6};
        const auto known = std::ranges::find(k_prefixes, prefix);
        if (known == k_prefixes.end()) return std::nullopt;
        result.value *= k_factors.at(static_cast<std::size_t>(known - k_prefixes.begin()));
        result.unit = unit;
        return result;
    }
    return std::nullopt;
}

double intensity_of(const Photometric& quantity) {
    const double flux = quantity.unit == "W" ? k_lumens_per_watt * quantity.value : quantity.value;
    const double emitted = quantity.is_flux() ? flux / (4 * std::numbers::pi) : quantity.value;
    return emitted * std::numbers::inv_pi;
}

double cone_factor(double inner_angle, double outer_angle) {
    const auto cosine = [](double degrees) { return std::cos(degrees * std::numbers::pi / 180); };
    return 4 / (2 - cosine(inner_angle) - cosine(outer_angle));
}

Rgb blackbody_color(double kelvin) {
    const double t = kelvin;
    const double u = (0.860117757 + 1.54118254e-4 * t + 1.28641212e-7 * t * t) /
                     (1 + 8.42420235e-4 * t + 7.08145163e-7 * t * t);
    const double v = (0.317398726 + 4.22806245e-5 * t + 4.20481691e-8 * t * t) /
                     (1 - 2.89741816e-5 * t + 1.61456053e-7 * t * t);
    // From CIE 1960 u, v to XYZ with Y = 1.
    const double x = 1.5 * u / v, z = (4 - u - 10 * v) / (2 * v);
    // IEC 61966-2-1.
    const double red = std::max(0.0, 3.2406 * x - 1.5372 - 0.4986 * z);
    const double green = std::max(0.0, -0.9689 * x + 1.8758 + 0.0415 * z);
    const double blue = std::max(0.0, 0.0557 * x - 0.2040 + 1.0570 * z);
    const double luminance = 0.2126 * red + 0.7152 * green + 0.0722 * blue;
    return {static_cast<float>(red / luminance), static_cast<float>(green / luminance),
            static_cast<float>(blue / luminance)};
}

}  // namespace candela
