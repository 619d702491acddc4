#include "plot/lobe.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <cstdint>
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

constexpr double k_step = 0.5;  // degrees
constexpr int k_half = 179;     // steps on each side, excluding the grazing directions

std::unique_ptr<candela::ReflectionModel> instance_of(const NamedModel& model, candela::Registry& registry) {
    const candela::Scene scene = scene_with(model, registry);
    const candela::Model& reflection = scene.objects.front().reflection;
    return registry.create<candela::ReflectionModel>(reflection.name, reflection.parameters,
                                                     scene.image.color_management);
}

/// A direction in the plane z = 0, whose normal is +y.
Vec3 direction_at(double degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    return {static_cast<float>(std::sin(angle)), static_cast<float>(std::cos(angle)), 0};
}

LobePoint point_at(const candela::ReflectionModel& model, double incidence, double angle) {
    const auto span = [](const Vec3& v) { return candela::ConstVec3Span{&v.x, &v.y, &v.z}; };
    const auto target = [](Vec3& v) { return candela::Vec3Span{&v.x, &v.y, &v.z}; };
    const Vec3 normal{0, 1, 0}, tangent{1, 0, 0}, origin{}, one{1, 1, 1};
    const Vec3 to_light = direction_at(-incidence), to_observer = direction_at(angle);
    const float zero = 0;
    Vec3 ambient{}, diffuse{}, specular{};
    model.reflect({.count = 1,
                   .normal = span(normal),
                   .to_observer = span(to_observer),
                   .tangent = span(tangent),
                   .color = {1, 1, 1},
                   .position = span(origin),
                   .uv = {&zero, &zero}},
                  {.to_light = span(to_light), .diffuse = span(one), .specular = span(one)},
                  {.ambient = target(ambient), .diffuse = target(diffuse), .specular = target(specular)});
    return {.angle = angle, .diffuse = luminance(diffuse), .specular = luminance(specular)};
}

double mean_square(const Lobe& a, const Lobe& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.points.size(); ++i)
        sum += std::pow(a.points[i].intensity() - b.points[i].intensity(), 2);
    return sum / static_cast<double>(a.points.size());
}

const candela::Parameter& number_called(const std::string& name, const NamedModel& model,
                                        candela::Registry& registry) {
    const auto& parameters =
        registry.require(candela::PluginKind::reflection, model.name).manifest.parameters;
    std::vector<std::string> numbers;
    for (const candela::Parameter& parameter : parameters) {
        if (parameter.type != candela::ParamType::real) continue;
        if (parameter.name == name) return parameter;
        numbers.push_back(parameter.name);
    }
    const std::string meant = candela::suggestion(name, numbers);
    throw Error(ErrorCategory::bad_request,
                fmt::format("{} has no number '{}' to fit; it has {}{}{}",
                            candela::plugin_id(candela::PluginKind::reflection, model.name), name,
                            numbers.empty() ? "none" : fmt::format("{}", fmt::join(numbers, ", ")),
                            meant.empty() ? "" : "; ", meant));
}

}  // namespace

double Lobe::peak() const {
    double peak = 0;
    for (const LobePoint& point : points) peak = std::max(peak, point.intensity());
    return peak;
}

Lobe lobe_of(const NamedModel& model, double incidence, candela::Registry& registry) {
    const auto instance = instance_of(model, registry);
    Lobe lobe{.label = model.label(), .points = {}};
    for (int i = -k_half; i <= k_half; ++i) lobe.points.push_back(point_at(*instance, incidence, k_step * i));
    return lobe;
}

Match match_lobe(const Lobe& target, const NamedModel& model, const std::string& parameter, double incidence,
                 candela::Registry& registry) {
    const candela::Parameter& range = number_called(parameter, model, registry);
    const double least = std::max(static_cast<double>(range.minimum), 1e-3);
    const double most = std::min(static_cast<double>(range.maximum), 1e5);
    // Exponents and roughnesses alike: their ratio matters.
    const double from = std::log(least), to = std::log(std::max(most, 2 * least));
    const auto error_at = [&](double logarithm) {
        NamedModel tried = model;
        std::erase_if(tried.values, [&](const auto& value) { return value.first == parameter; });
        tried.values.emplace_back(parameter, fmt::format("{}", static_cast<float>(std::exp(logarithm))));
        return mean_square(target, lobe_of(tried, incidence, registry));
    };
    // There may be several minima: a coarse search finds the lowest, then Brent's method (1973) refines it.
    constexpr int k_coarse = 64;
    const double step = (to - from) / k_coarse;
    int best = 0;
    double lowest = error_at(from);
    for (int i = 1; i <= k_coarse; ++i) {
        const double error = error_at(from + i * step);
        if (error < lowest) lowest = error, best = i;
    }
    constexpr int k_bits = 24;
    std::uintmax_t rounds = 100;
    const auto [at, error] =
        boost::math::tools::brent_find_minima(error_at, std::max(from, from + (best - 1) * step),
                                              std::min(to, from + (best + 1) * step), k_bits, rounds);
    return {.value = std::exp(at),
            .error = std::sqrt(std::min(error, lowest)) / std::max(target.peak(), 1e-30)};
}
