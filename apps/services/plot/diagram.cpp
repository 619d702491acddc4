#include "plot/diagram.h"

#include <fmt/format.h>

#include <array>
#include <string_view>

#include "candela/target/literals.h"

import candela.util;

namespace {

/// Okabe and Ito (2008), "Color universal design": distinguishable with colour blindness, and by their
/// dashes.
constexpr std::array<std::string_view, 6> k_colors = {"#0072b2", "#d55e00", "#009e73",
                                                      "#cc79a7", "#e69f00", "#56b4e9"};
constexpr std::array<std::string_view, 6> k_dashes = {"none", "9 4", "2 4", "12 4 2 4", "5 5", "1 3"};

}  // namespace

double luminance(const candela::Vec3& rgb) {
    return 0.2126 * static_cast<double>(rgb.x) + 0.7152 * static_cast<double>(rgb.y) +
           0.0722 * static_cast<double>(rgb.z);
}

std::string in_xml(const std::string& text) { return candela::target::html_text(candela::printable(text)); }

/// A CSV cell as in RFC 4180.
std::string in_csv(const std::string& text) {
    if (text.find_first_of(",\"\n") == std::string::npos) return text;
    std::string result = "\"";
    for (const char c : text) result += c == '"' ? std::string("\"\"") : std::string(1, c);
    return result + '"';
}

std::string curve_style(std::size_t index) {
    return fmt::format(R"(fill="none" stroke="{}" stroke-width="2" stroke-dasharray="{}")",
                       k_colors[index % k_colors.size()], k_dashes[index % k_dashes.size()]);
}

std::string legend_of(const std::vector<std::string>& labels, double y) {
    std::string text;
    for (std::size_t i = 0; i < labels.size(); ++i) {
        const double row = y + k_legend_row * static_cast<double>(i);
        text += fmt::format("<path {} d=\"M60 {} H110\"/>\n<text x=\"120\" y=\"{}\">{}</text>\n",
                            curve_style(i), row - 4, row, in_xml(labels[i]));
    }
    return text;
}

std::string svg_begin(double width, double height, const std::string& title,
                      const std::vector<std::string>& labels, const std::string& description) {
    std::string all;
    for (const std::string& label : labels) all += (all.empty() ? "" : ", ") + in_xml(label);
    return fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {}\" role=\"img\" "
        "aria-labelledby=\"title description\" font-family=\"sans-serif\" font-size=\"13\">\n"
        "<title id=\"title\">{}: {}</title>\n<desc id=\"description\">{}</desc>\n"
        "<style>.line{{fill:none;stroke:#777}}text{{fill:#222}}"
        "@media(prefers-color-scheme:dark){{text{{fill:#ddd}}.line{{stroke:#888}}}}</style>\n",
        width, height, title, all, description);
}
