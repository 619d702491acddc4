#include "plot/light_curves.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "plot/diagram.h"

import candela.api;
import candela.plugins;
import candela.scene;
import candela.util;

using candela::Error;
using candela::ErrorCategory;
using candela::Vec3;

namespace {

constexpr double k_degrees = 0.5;  // between points
constexpr int k_angles = 180;      // steps up to a right angle
constexpr int k_per_decade = 20;

/// A light with its position and its axis.
class PlacedLight {
  public:
    PlacedLight(const NamedModel& named, candela::Registry& registry) {
        const candela::Scene scene = scene_with(named, registry);
        const candela::Model& model = scene.lights.front().model;
        light_ = registry.create<candela::Light>(model.name, model.parameters, scene.image.color_management);
        if (light_->sample_count() == 0)
            throw Error(ErrorCategory::bad_request,
                        fmt::format("{} comes from everywhere: its intensity depends on neither an angle nor "
                                    "a distance",
                                    candela::plugin_id(candela::PluginKind::light, model.name)));
        const auto& parameters = registry.require(candela::PluginKind::light, model.name).manifest.parameters;
        const auto runtime = model.parameters.runtime(scene.image.color_management);
        for (std::size_t i = 0; i < parameters.size(); ++i) {
            const float* const number = runtime[i].number;
            if (parameters[i].name == "position") position_ = {number[0], number[1], number[2]};
            if (parameters[i].name == "direction")
                axis_ = candela::normalized({number[0], number[1], number[2]});
        }
        const Vec3 other = std::abs(axis_.x) < 0.7f ? Vec3{1, 0, 0} : Vec3{0, 0, 1};
        aside_ = candela::normalized(other - dot(other, axis_) * axis_);
    }

    double at(double degrees, double distance) const {
        const double angle = degrees * std::numbers::pi / 180;
        const Vec3 away =
            static_cast<float>(std::cos(angle)) * axis_ + static_cast<float>(std::sin(angle)) * aside_;
        const Vec3 place = position_ + static_cast<float>(distance) * away, normal = -away;
        double sum = 0;
        for (int sample = 0; sample < light_->sample_count(); ++sample) {
            Vec3 to_light{}, diffuse{}, specular{};
            const auto target = [](Vec3& v) { return candela::Vec3Span{&v.x, &v.y, &v.z}; };
            light_->illuminate(
                sample,
                {.count = 1,
                 .position = {&place.x, &place.y, &place.z},
                 .normal = {&normal.x, &normal.y, &normal.z}},
                {.to_light = target(to_light), .diffuse = target(diffuse), .specular = target(specular)});
            sum += luminance(diffuse);
        }
        return sum;
    }

  private:
    std::unique_ptr<candela::Light> light_;
    Vec3 position_{}, axis_{0, -1, 0}, aside_{};
};

}  // namespace

LightCurves light_curves_of(const NamedModel& light, candela::Registry& registry) {
    const PlacedLight placed(light, registry);
    LightCurves curves{.label = light.label(), .by_angle = {}, .by_distance = {}};
    for (int i = 0; i <= k_angles; ++i)
        curves.by_angle.push_back({k_degrees * i, placed.at(k_degrees * i, 1)});
    for (int i = -k_per_decade; i <= k_per_decade; ++i) {
        const double distance = std::pow(10, static_cast<double>(i) / k_per_decade);
        curves.by_distance.push_back({distance, placed.at(0, distance)});
    }
    return curves;
}
