#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "plot/diagram.h"
#include "plot/light_curves.h"

import candela.util;

namespace {

constexpr double k_width = 900, k_panel_width = 370, k_top = 40, k_height = 300, k_left = 60, k_gap = 70;

/// A diagram's frame, with coordinates from 0 to 1 in both directions.
struct Panel {
    double left;

    double x(double share) const { return left + k_panel_width * share; }
    double y(double share) const { return k_top + k_height * (1 - std::clamp(share, 0.0, 1.0)); }

    std::string frame(const std::string& title, const std::string& below) const {
        return fmt::format(
            "<rect class=\"line\" stroke-width=\"1\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/>\n"
            "<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n"
            "<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n",
            left, k_top, k_panel_width, k_height, x(0.5), k_top - 14, title, x(0.5), k_top + k_height + 36,
            below);
    }
    std::string mark_below(double share, const std::string& label) const {
        return fmt::format(
            "<path class=\"line\" stroke-width=\"0.5\" d=\"M{0:.1f} {1} V{2}\"/>\n"
            "<text x=\"{0:.1f}\" y=\"{3}\" text-anchor=\"middle\" font-size=\"11\">{4}</text>\n",
            x(share), k_top, k_top + k_height, k_top + k_height + 16, label);
    }
    std::string mark_beside(double share, const std::string& label) const {
        return fmt::format(
            "<path class=\"line\" stroke-width=\"0.5\" d=\"M{0:.1f} {1:.1f} H{2:.1f}\"/>\n"
            "<text x=\"{3:.1f}\" y=\"{4:.1f}\" text-anchor=\"end\" font-size=\"11\">{5}</text>\n",
            left, y(share), x(1), left - 6, y(share) + 4, label);
    }
    std::string curve(std::size_t index, const std::vector<LightPoint>& points,
                      const std::function<std::pair<double, double>(const LightPoint&)>& place) const {
        std::string text;
        for (const LightPoint& point : points) {
            const auto [across, up] = place(point);
            text += fmt::format("{}{:.2f},{:.2f}", text.empty() ? "" : " ", x(across), y(up));
        }
        return fmt::format("<polyline {} points=\"{}\"/>\n", curve_style(index), text);
    }
};

std::string angle_panel(const std::vector<LightCurves>& lights) {
    constexpr double k_right_angle = 90;
    const Panel panel{k_left};
    std::string text = panel.frame("relative intensity", "degrees from the axis");
    for (int degrees = 0; degrees <= 90; degrees += 15)
        text += panel.mark_below(degrees / k_right_angle, fmt::format("{}°", degrees));
    for (int i = 0; i <= 4; ++i) text += panel.mark_beside(i / 4.0, fmt::format("{:g}", i / 4.0));
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const double full = lights[i].by_angle.front().intensity;
        text += panel.curve(i, lights[i].by_angle, [&](const LightPoint& point) {
            return std::pair(point.at / k_right_angle, full > 0 ? point.intensity / full : 0);
        });
    }
    return text;
}

std::string distance_panel(const std::vector<LightCurves>& lights) {
    double peak = 0, least = 0;
    for (const LightCurves& light : lights)
        for (const LightPoint& point : light.by_distance) peak = std::max(peak, point.intensity);
    for (const LightCurves& light : lights) {
        for (const LightPoint& point : light.by_distance)
            if (point.intensity > 0 && (least == 0 || point.intensity < least)) least = point.intensity;
    }
    const double high = peak > 0 ? std::ceil(std::log10(peak) - 1e-9) : 0;
    // At most eight powers of ten; lower values lie on the edge.
    const double low = std::max(least > 0 ? std::floor(std::log10(least) + 1e-9) : high - 1, high - 8);
    const double range = std::max(high - low, 1.0);
    const Panel panel{k_left + k_panel_width + k_gap};
    std::string text = panel.frame("intensity on the axis", "metres");
    for (const double distance : {0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0})
        text += panel.mark_below((std::log10(distance) + 1) / 2, fmt::format("{:g}", distance));
    for (int i = 0; i <= static_cast<int>(range); ++i)
        text += panel.mark_beside(i / range, fmt::format("{:g}", std::pow(10, low + i)));
    for (std::size_t i = 0; i < lights.size(); ++i) {
        text += panel.curve(i, lights[i].by_distance, [&](const LightPoint& point) {
            return std::pair((std::log10(point.at) + 1) / 2,
                             point.intensity > 0 ? (std::log10(point.intensity) - low) / range : 0);
        });
    }
    return text;
}

}  // namespace

std::string light_curves_csv(const std::vector<LightCurves>& lights) {
    std::string text = "over,at";
    for (const LightCurves& light : lights) text += "," + in_csv(candela::printable(light.label));
    text += '\n';
    const auto rows = [&](const char* over, std::vector<LightPoint> LightCurves::* points) {
        for (std::size_t i = 0; i < (lights.front().*points).size(); ++i) {
            text += fmt::format("{},{:.7g}", over, (lights.front().*points)[i].at);
            for (const LightCurves& light : lights)
                text += fmt::format(",{:.7g}", (light.*points)[i].intensity);
            text += '\n';
        }
    };
    rows("angle", &LightCurves::by_angle);
    rows("distance", &LightCurves::by_distance);
    return text;
}

std::string light_curves_svg(const std::vector<LightCurves>& lights) {
    std::vector<std::string> labels;
    for (const LightCurves& light : lights) labels.push_back(light.label);
    constexpr double k_legend = k_top + k_height + 66;
    return svg_begin(k_width, k_legend + k_legend_row * static_cast<double>(lights.size()) - 10,
                     "Emitted light", labels,
                     "Two diagrams: the intensity over the angle with the axis, relative to that on the "
                     "axis, and the intensity "
                     "over the distance, both axes logarithmic.") +
           angle_panel(lights) + distance_panel(lights) + legend_of(labels, k_legend) + "</svg>\n";
}
