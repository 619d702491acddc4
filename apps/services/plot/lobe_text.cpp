#include "plot/lobe_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plot/diagram.h"

import candela.util;

namespace {

constexpr double k_width = 720, k_center_x = 360, k_center_y = 335, k_radius = 300;
constexpr double k_decades = 4;  // of a logarithmic diagram

/// The smallest 1, 2 or 5 times a power of ten that is not less.
double rounded_up(double x) {
    const double power = std::pow(10, std::floor(std::log10(x)));
    for (const double digit : {1.0, 2.0, 5.0})
        if (x <= digit * power * (1 + 1e-9)) return digit * power;
    return 10 * power;
}

struct PlotPoint {
    double x, y;
};

PlotPoint point_at(double degrees, double radius) {
    const double angle = degrees * std::numbers::pi / 180;
    return {k_center_x + radius * std::sin(angle), k_center_y - radius * std::cos(angle)};
}

class Diagram {
  public:
    Diagram(const std::vector<Lobe>& lobes, double incidence, RadialScale scale)
        : lobes_(lobes), incidence_(incidence), scale_(scale) {
        double peak = 0;
        for (const Lobe& lobe : lobes) peak = std::max(peak, lobe.peak());
        full_ = peak > 0 ? rounded_up(peak) : 1;
    }

    std::string text() const {
        const double height = k_center_y + 40 + k_legend_row * static_cast<double>(lobes_.size());
        return svg_begin(k_width, height, "Reflected intensity", labels(),
                         fmt::format(
                             "Polar diagram in the plane of incidence, {} from 0 to {:g}. Light arrives from "
                             "the left, {:g} degrees from the normal.",
                             scale_ == RadialScale::linear ? "linear" : "logarithmic", full_, incidence_)) +
               grid() + light() + curves() + legend_of(labels(), k_center_y + 46) + "</svg>\n";
    }

  private:
    double radius_of(double intensity) const {
        const double share = intensity / full_;
        if (scale_ == RadialScale::linear) return k_radius * std::clamp(share, 0.0, 1.0);
        return share <= 0 ? 0 : k_radius * std::clamp(1 + std::log10(share) / k_decades, 0.0, 1.0);
    }

    std::string grid() const {
        std::string text;
        for (int i = 1; i <= 4; ++i) {
            const double radius = k_radius * i / 4;
            const double value =
                scale_ == RadialScale::linear ? full_ * i / 4 : full_ * std::pow(10, k_decades * (i - 4) / 4);
            text += fmt::format(
                "<path class=\"line\" stroke-width=\"0.5\" d=\"M{:.1f} {} A{:.1f} {:.1f} 0 0 1 {:.1f} "
                "{}\"/>\n"
                "<text x=\"{:.1f}\" y=\"{}\" text-anchor=\"middle\" font-size=\"11\">{:g}</text>\n",
                k_center_x - radius, k_center_y, radius, radius, k_center_x + radius, k_center_y,
                k_center_x + radius, k_center_y + 16, value);
        }
        for (int degrees = -90; degrees <= 90; degrees += 15) {
            const PlotPoint end = point_at(degrees, k_radius), label = point_at(degrees, k_radius + 16);
            text += fmt::format(
                "<path class=\"line\" stroke-width=\"0.5\" d=\"M{} {} L{:.1f} {:.1f}\"/>\n"
                "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\" font-size=\"11\">{}°</text>\n",
                k_center_x, k_center_y, end.x, end.y, label.x, label.y + 4, degrees);
        }
        return text;
    }

    /// An arrow for the incoming light, and a dashed line for the mirror direction.
    std::string light() const {
        const PlotPoint from = point_at(-incidence_, k_radius), head = point_at(-incidence_, 26);
        const PlotPoint left = point_at(-incidence_ - 12, 42), right = point_at(-incidence_ + 12, 42);
        const PlotPoint mirror = point_at(incidence_, k_radius);
        return fmt::format(
            "<path class=\"line\" stroke-width=\"2\" d=\"M{:.1f} {:.1f} L{:.1f} {:.1f} M{:.1f} {:.1f} "
            "L{:.1f} {:.1f} "
            "L{:.1f} {:.1f}\"/>\n"
            "<path class=\"line\" stroke-width=\"1.5\" stroke-dasharray=\"3 5\" d=\"M{} {} L{:.1f} "
            "{:.1f}\"/>\n",
            from.x, from.y, head.x, head.y, left.x, left.y, head.x, head.y, right.x, right.y, k_center_x,
            k_center_y, mirror.x, mirror.y);
    }

    std::string curves() const {
        std::string text;
        for (std::size_t i = 0; i < lobes_.size(); ++i) {
            std::string points;
            for (const LobePoint& point : lobes_[i].points) {
                const PlotPoint place = point_at(point.angle, radius_of(point.intensity()));
                points += fmt::format("{}{:.2f},{:.2f}", points.empty() ? "" : " ", place.x, place.y);
            }
            text += fmt::format("<polyline {} points=\"{}\"/>\n", curve_style(i), points);
        }
        return text;
    }

    std::vector<std::string> labels() const {
        std::vector<std::string> labels;
        for (const Lobe& lobe : lobes_) labels.push_back(lobe.label);
        return labels;
    }

    const std::vector<Lobe>& lobes_;
    double incidence_;
    RadialScale scale_;
    double full_ = 1;  // the intensity at the diagram's rim
};

}  // namespace

std::string lobes_csv(const std::vector<Lobe>& lobes) {
    std::string text = "angle";
    for (const Lobe& lobe : lobes) {
        for (const char* const part : {" diffuse", " specular", " intensity"})
            text += "," + in_csv(candela::printable(lobe.label) + part);
    }
    text += '\n';
    for (std::size_t i = 0; i < lobes.front().points.size(); ++i) {
        text += fmt::format("{}", lobes.front().points[i].angle);
        for (const Lobe& lobe : lobes) {
            const LobePoint& point = lobe.points[i];
            text += fmt::format(",{:.7g},{:.7g},{:.7g}", point.diffuse, point.specular, point.intensity());
        }
        text += '\n';
    }
    return text;
}

std::string lobes_svg(const std::vector<Lobe>& lobes, double incidence, RadialScale scale) {
    return Diagram(lobes, incidence, scale).text();
}
