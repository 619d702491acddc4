// Requirements for reflection models, and for what they declare.
#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "batch.h"
#include "incident.h"

import candela.api;

using candela::ReflectionModel;
using candela::Vec3;

namespace {

constexpr Vec3 k_up{0, 1, 0};
constexpr Vec3 k_tangent{1, 0, 0};

/// The reflection of white light of intensity 1 by a model, for many pairs of directions on one surface.
class Reflections {
  public:
    explicit Reflections(const Values& values) : model_(make<ReflectionModel>(values)) {}

    /// Sum of the diffuse and specular part, channel by channel.
    std::vector<Vec3> of(const std::vector<Vec3>& to_observer, const std::vector<Vec3>& to_light,
                         Vec3 normal = k_up, Vec3 tangent = k_tangent) const {
        return of(inputs(to_observer, to_light, normal, tangent));
    }

    /// The same inputs, for comparing several models.
    static Arrays inputs(const std::vector<Vec3>& to_observer, const std::vector<Vec3>& to_light,
                         Vec3 normal = k_up, Vec3 tangent = k_tangent) {
        const std::size_t count = to_light.size();
        Arrays in(18, count);
        for (std::size_t i = 0; i < count; ++i) {
            in.vec3(0).set(i, normal);
            in.vec3(3).set(i, to_observer[i]);
            in.vec3(6).set(i, tangent);
            in.vec3(9).set(i, to_light[i]);
            in.vec3(12).set(i, {1, 1, 1});
            in.vec3(15).set(i, {0.1f, 0.2f, 0.3f});
        }
        return in;
    }

    std::vector<Vec3> of(const Arrays& given) const {
        const candela::SurfaceNeeds& needs = subject().surface_needs;
        const std::size_t count = given.count();
        Arrays out(9, count);
        model_->reflect(
            {.count = count,
             .normal = given.vec3(0),
             .to_observer = given.vec3(3),
             .tangent = needs.tangent ? given.vec3(6) : candela::ConstVec3Span{},
             .color = {1, 1, 1},
             .position = given.vec3(15),
             .uv = needs.uv ? candela::ConstVec2Span{given[15], given[16]} : candela::ConstVec2Span{}},
            {.to_light = given.vec3(9), .diffuse = given.vec3(12), .specular = given.vec3(12)},
            {.ambient = out.vec3(0), .diffuse = out.vec3(3), .specular = out.vec3(6)});
        std::vector<Vec3> sums;
        for (std::size_t i = 0; i < count; ++i) sums.push_back(out.at(3, i) + out.at(6, i));
        return sums;
    }

  private:
    std::unique_ptr<ReflectionModel> model_;
};

Vec3 above(double theta, double phi) {
    return {static_cast<float>(std::sin(theta) * std::cos(phi)), static_cast<float>(std::cos(theta)),
            static_cast<float>(std::sin(theta) * std::sin(phi))};
}

float largest(Vec3 v) { return std::max({v.x, v.y, v.z}); }

std::vector<Vec3> random_directions_above(std::size_t count, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<Vec3> result;
    for (std::size_t i = 0; i < count; ++i)
        result.push_back(above(std::acos(unit(random)), 2 * std::numbers::pi * unit(random)));
    return result;
}

/// The fraction of light that leaves towards an observer: the integral of the reflection over all directions
/// of light, over pi (a white Lambert surface has 1). Polar coordinates around the mirror direction, with
/// distances in even logarithmic steps to catch narrow highlights: 16,384 directions.
class DirectionalAlbedo {
  public:
    explicit DirectionalAlbedo(Vec3 to_observer)
        : DirectionalAlbedo(lights_around(to_observer), to_observer) {}

    double of(const Reflections& reflections) const {
        const std::vector<Vec3> reflected = reflections.of(inputs_);
        double albedo = 0;
        for (std::size_t i = 0; i < weights_.size(); ++i)
            albedo += weights_[i] * double{largest(reflected[i])};
        return albedo / std::numbers::pi;
    }

  private:
    struct Lights {
        std::vector<Vec3> directions;
        std::vector<double> weights;
    };

    DirectionalAlbedo(Lights lights, Vec3 to_observer)
        : weights_(std::move(lights.weights)),
          inputs_(Reflections::inputs(std::vector<Vec3>(weights_.size(), to_observer), lights.directions)) {}

    static Lights lights_around(Vec3 to_observer) {
        constexpr int k_rings = 128, k_spokes = 128;
        const Vec3 mirror = 2 * dot(k_up, to_observer) * k_up - to_observer;
        const Vec3 aside = candela::normalized(std::abs(mirror.y) < 0.9f ? cross(k_up, mirror)
                                                                         : cross(Vec3{1, 0, 0}, mirror));
        const Vec3 across = cross(mirror, aside);
        const double nearest = std::log(1e-4), farthest = std::log(std::numbers::pi);
        Lights lights;
        for (int ring = 0; ring < k_rings; ++ring) {
            const double step = (farthest - nearest) / k_rings;
            const double angle = std::exp(nearest + (ring + 0.5) * step);
            for (int spoke = 0; spoke < k_spokes; ++spoke) {
                const double phi = 2 * std::numbers::pi * (spoke + 0.5) / k_spokes;
                const Vec3 l = static_cast<float>(std::cos(angle)) * mirror +
                               static_cast<float>(std::sin(angle) * std::cos(phi)) * aside +
                               static_cast<float>(std::sin(angle) * std::sin(phi)) * across;
                if (l.y <= 0) continue;
                lights.directions.push_back(candela::normalized(l));
                lights.weights.push_back(std::sin(angle) * angle * step * 2 * std::numbers::pi / k_spokes);
            }
        }
        return lights;
    }

    std::vector<double> weights_;
    Arrays inputs_;
};

/// Values for which k_d + k_s does not exceed 1: if a model says that a larger sum reflects more light than
/// it receives, its energy is bounded only for these.
bool is_bounded(const Values& values) {
    return std::ranges::none_of(subject_manifest().relations, [&](const candela::Relation& relation) {
        return candela::validation_error(relation, values.set).has_value();
    });
}

}  // namespace

TEST_CASE("horizon: light from below the surface is not reflected, unless declared", "[reflection]") {
    if (declares("lights-below-horizon")) SKIP("it declares lights-below-horizon");
    const std::vector<Vec3> observers = random_directions_above(500, 2);
    std::vector<Vec3> lights;
    for (const Vec3 l : random_directions_above(500, 3)) lights.push_back({l.x, -l.y, l.z});
    for (const Values& values : many_values()) {
        const std::vector<Vec3> reflected = Reflections(values).of(observers, lights);
        for (std::size_t i = 0; i < reflected.size(); ++i) {
            if (largest(reflected[i]) > 1e-6f)
                FAIL("light from " << std::asin(double{lights[i].y}) * 180 / std::numbers::pi
                                   << " degrees below the horizon is reflected, " << largest(reflected[i])
                                   << ", with " << values.text);
        }
    }
}

TEST_CASE(
    "grazing: light and observers along the surface, or straight above it, yield finite, non-negative "
    "results",
    "[reflection]") {
    std::vector<Vec3> observers, lights;
    const std::vector<double> angles{0,
                                     1e-4,
                                     0.5,
                                     1.57,
                                     std::numbers::pi / 2 - 1e-4,
                                     std::numbers::pi / 2 - 1e-6,
                                     std::numbers::pi / 2,
                                     std::numbers::pi / 2 + 1e-6,
                                     2,
                                     std::numbers::pi};
    for (const double v : angles) {
        for (const double l : angles) {
            for (const double phi : {0.0, std::numbers::pi / 2, std::numbers::pi, 3.0}) {
                observers.push_back(above(v, 0));
                lights.push_back(above(l, phi));
            }
        }
    }
    for (const Values& values : many_values()) {
        const std::vector<Vec3> reflected = Reflections(values).of(observers, lights);
        for (std::size_t i = 0; i < reflected.size(); ++i) {
            const Vec3 r = reflected[i];
            const bool finite = std::isfinite(r.x) && std::isfinite(r.y) && std::isfinite(r.z);
            if (!finite || (!declares("may-be-negative") && std::min({r.x, r.y, r.z}) < 0))
                FAIL("it reflects [" << r.x << ", " << r.y << ", " << r.z << "] with N.V = " << observers[i].y
                                     << ", N.L = " << lights[i].y << ", V.L = "
                                     << dot(observers[i], lights[i]) << ", with " << values.text);
        }
    }
}

namespace {

/// The reflection without the cosine of the light.
std::vector<double> without_cosine(const std::vector<Vec3>& reflected, const std::vector<Vec3>& to_light) {
    std::vector<double> result;
    for (std::size_t i = 0; i < reflected.size(); ++i)
        result.push_back(double{largest(reflected[i])} / double{to_light[i].y});
    return result;
}

/// Each direction turned by a few of a float's last bits, towards one of two sides.
std::vector<Vec3> nudged(const std::vector<Vec3>& directions, bool sideways) {
    constexpr float k_angle = 1e-6f;
    std::vector<Vec3> result;
    for (const Vec3 d : directions) {
        const Vec3 across = candela::normalized(cross(d, std::abs(d.y) < 0.9f ? k_up : k_tangent));
        result.push_back(candela::normalized(d + k_angle * (sideways ? across : cross(across, d))));
    }
    return result;
}

/// How much rounding may change a reflection without the cosine: as much as turning the directions by a few
/// of their last bits does, which is much at the flank of a narrow highlight, and next to nothing elsewhere.
std::vector<double> effect_of_rounding(const Reflections& reflections, const std::vector<Vec3>& v,
                                       const std::vector<Vec3>& l, const std::vector<double>& exact) {
    std::vector<double> effect;
    for (const double value : exact) effect.push_back(1e-5 * value + 1e-6);
    for (const bool sideways : {false, true}) {
        const std::vector<Vec3> other_v = nudged(v, sideways), other_l = nudged(l, sideways);
        const std::vector<double> for_v = without_cosine(reflections.of(other_v, l), l),
                                  for_l = without_cosine(reflections.of(v, other_l), other_l);
        for (std::size_t i = 0; i < effect.size(); ++i)
            effect[i] += std::abs(for_v[i] - exact[i]) + std::abs(for_l[i] - exact[i]);
    }
    return effect;
}

}  // namespace

TEST_CASE("reciprocal, if declared: light and observer may change places (Helmholtz)", "[reflection]") {
    if (declared("reciprocal").empty()) SKIP("not declared");
    const std::vector<Vec3> v = random_directions_above(2000, 4), l = random_directions_above(2000, 5);
    for (const Values& values : many_values()) {
        if (!declares_for("reciprocal", values)) continue;
        const Reflections reflections(values);
        const std::vector<double> forth = without_cosine(reflections.of(v, l), l),
                                  back = without_cosine(reflections.of(l, v), v),
                                  rounding = effect_of_rounding(reflections, v, l, forth);
        for (std::size_t i = 0; i < v.size(); ++i) {
            if (v[i].y < 0.01f || l[i].y < 0.01f) continue;
            if (!(std::abs(forth[i] - back[i]) <= rounding[i]))
                FAIL("it is not reciprocal: " << forth[i] << " one way and " << back[i]
                                              << " the other, while rounding explains a difference of "
                                              << rounding[i] << ", for V = [" << v[i].x << ", " << v[i].y
                                              << ", " << v[i].z << "], L = [" << l[i].x << ", " << l[i].y
                                              << ", " << l[i].z << "], with " << values.text);
        }
    }
}

TEST_CASE("energy-bounded, if declared: no direction receives more light than falls in", "[reflection]") {
    if (declared("energy-bounded").empty()) SKIP("not declared");
    std::vector<Values> bounded;
    std::vector<Reflections> models;
    for (const Values& values : many_values()) {
        if (!is_bounded(values) || !declares_for("energy-bounded", values)) continue;
        bounded.push_back(values);
        models.emplace_back(values);
    }
    // Densest at grazing angles, where most models are brightest.
    for (const double degrees : {0.5, 15.0, 30.0, 45.0, 60.0, 70.0, 80.0, 85.0, 88.0, 89.9}) {
        const DirectionalAlbedo albedo(above(degrees * std::numbers::pi / 180, 0.7));
        for (std::size_t k = 0; k < models.size(); ++k) {
            const double share = albedo.of(models[k]);
            if (!(share <= 1.01))
                FAIL("it emits " << share << " times the incident light towards an observer at " << degrees
                                 << " degrees from N, with " << bounded[k].text);
        }
    }
}

TEST_CASE("isotropic, if declared: turning the surface about its normal changes nothing", "[reflection]") {
    if (declared("isotropic").empty()) SKIP("not declared");
    const std::vector<Vec3> v = random_directions_above(300, 6), l = random_directions_above(300, 7);
    for (const Values& values : many_values(10)) {
        if (!declares_for("isotropic", values)) continue;
        const Reflections reflections(values);
        const std::vector<Vec3> before = reflections.of(v, l);
        for (const float angle : {0.5f, 1.6f, 3.0f}) {
            const Vec3 turned{std::cos(angle), 0, std::sin(angle)};
            const std::vector<Vec3> after = reflections.of(v, l, k_up, turned);
            for (std::size_t i = 0; i < v.size(); ++i) {
                if (!(std::abs(largest(before[i]) - largest(after[i])) <= 1e-5f * largest(before[i]) + 1e-6f))
                    FAIL("turned by " << angle << " rad about N it reflects " << largest(after[i])
                                      << " instead of " << largest(before[i]) << ", with " << values.text);
            }
        }
    }
}

namespace {

/// The results of reflect() and reflect_ambient() for lighting that is data, light by light, with all vectors
/// to the lights turned slightly.
std::vector<Vec3> one_by_one(const Values& values, const Arrays& given, Vec3 turn) {
    const candela::PunctualLighting& lighting = punctual_lighting();
    Arrays in = given;
    std::vector<Vec3> sums(in.count());
    for (std::size_t i = 0; i < in.count(); ++i)
        in.vec3(inputs::k_observer)
            .set(i, candela::normalized(lighting.observer - in.at(inputs::k_position, i)));
    const BatchSubject subject = batch_subject(values);
    const auto add = [&](const char* name) {
        const auto call = std::ranges::find(subject.calls, name, &Call::name);
        const Arrays out = outputs_of(*call, in);
        for (std::size_t i = 0; i < in.count(); ++i)
            sums[i] = sums[i] + out.at(0, i) + out.at(3, i) + out.at(6, i);
    };
    for (std::size_t i = 0; i < in.count(); ++i)
        in.vec3(inputs::k_diffuse).set(i, {lighting.ambient.r, lighting.ambient.g, lighting.ambient.b});
    add("reflect_ambient");
    for (const candela::PunctualLight& light : lighting.lights) {
        for (std::size_t i = 0; i < in.count(); ++i) {
            const ExactIncident incident = incident_of(light, in.at(inputs::k_position, i));
            const auto share = static_cast<float>(incident.share);
            in.vec3(inputs::k_light).set(i, candela::normalized(incident.to_light + turn));
            in.vec3(inputs::k_diffuse)
                .set(i, share * Vec3{light.diffuse.r, light.diffuse.g, light.diffuse.b});
            in.vec3(inputs::k_specular)
                .set(i, share * Vec3{light.specular.r, light.specular.g, light.specular.b});
        }
        add("reflect");
    }
    return sums;
}

}  // namespace

TEST_CASE("in one go: a model reflects many lights like their sum one by one", "[reflection]") {
    const Arrays in = inputs_for(500, 31);
    for (const Values& values : many_values(10)) {
        const BatchSubject subject = batch_subject(values);
        const auto call = std::ranges::find(subject.calls, "reflect_all_lights", &Call::name);
        if (call == subject.calls.end()) SKIP("it has no reflect_all_lights()");
        const Arrays out = outputs_of(*call, in);
        // Sharp highlights and models with steps are sensitive even to rounding of directions.
        constexpr float k_rounding = 1e-6f;
        std::vector<std::vector<Vec3>> sums;
        for (const Vec3 turn :
             {Vec3{}, Vec3{k_rounding, 0, 0}, Vec3{-k_rounding, 0, 0}, Vec3{0, k_rounding, 0},
              Vec3{0, -k_rounding, 0}, Vec3{0, 0, k_rounding}, Vec3{0, 0, -k_rounding}})
            sums.push_back(one_by_one(values, in, turn));
        for (std::size_t i = 0; i < in.count(); ++i) {
            const float got = largest(out.at(0, i));
            float low = largest(sums[0][i]), high = low;
            for (const std::vector<Vec3>& sum : sums) {
                low = std::min(low, largest(sum[i]));
                high = std::max(high, largest(sum[i]));
            }
            const float rounding = high - low + 1e-5f * high + 1e-6f;
            if (!(got >= low - rounding && got <= high + rounding))
                FAIL("reflect_all_lights returns "
                     << got << " for three lights and ambient light; one by one they "
                     << "are " << largest(sums[0][i]) << ", for " << text_of_input(in, i) << ", with "
                     << values.text);
        }
    }
}

TEST_CASE(
    "colours: a point with its own colour looks like a point of a surface that has that colour everywhere",
    "[reflection]") {
    constexpr std::size_t k_points = 70;  // more than a pass of the SDK's loops
    const Arrays in = inputs_for(k_points, 37);
    for (const Values& values : many_values(3)) {
        const BatchSubject own = batch_subject(values);
        std::vector<Arrays> together;
        for (const Call& call : own.calls) together.push_back(outputs_of(call, in));
        for (std::size_t i = 0; i < k_points; i += 3) {
            const Vec3 color = in.at(inputs::k_color, i);
            const BatchSubject one = subject_of_one_color(values, {color.x, color.y, color.z});
            for (std::size_t c = 0; c < own.calls.size(); ++c) {
                const Arrays alone = outputs_of(one.calls[c], in.part(i, 1));
                for (std::size_t channel = 0; channel < alone.arrays(); ++channel) {
                    const float expected = alone[channel][0], got = together[c][channel][i];
                    if (!(std::abs(got - expected) <= 1e-5f * std::abs(expected) + 1e-6f))
                        FAIL(own.calls[c].name
                             << " returns " << got << " in " << own.calls[c].outputs[channel / 3]
                             << " at point " << i << ", whose colour is [" << color.x << ", " << color.y
                             << ", " << color.z << "] (SurfaceBatch::point_color), and " << expected
                             << " where the surface has that colour, for " << text_of_input(in, i)
                             << ", with " << values.text);
                }
            }
        }
    }
}

TEST_CASE("surroundings: with one intensity from everywhere, no more than that is visible in the object",
          "[reflection]") {
    class Furnace final : public candela::Environment {
      public:
        void look(std::size_t count, const candela::ConstVec3Span&,
                  const candela::Vec3Span& intensity) override {
            for (std::size_t i = 0; i < count; ++i) intensity.set(i, {1, 1, 1});
        }
        float max_intensity() const noexcept override { return 1; }
        void trace_exit(std::size_t count, const candela::ConstVec3Span& origin,
                        const candela::ConstVec3Span& direction, const candela::ExitBatch& exit) override {
            for (std::size_t i = 0; i < count; ++i) {
                exit.position.set(i, origin[i]);
                exit.normal.set(i, direction[i]);
                exit.distance[i] = 0;
            }
        }
    };
    for (const Values& values : many_values()) {
        const auto model = make<ReflectionModel>(values);
        const auto* const shown = candela::extension_of<candela::EnvironmentReflection>(*model);
        if (shown == nullptr) SKIP("it does not show its surroundings");
        const Arrays in = inputs_for(1000);
        Arrays out(9, in.count());
        Furnace furnace;
        const candela::SurfaceNeeds& needs = subject().surface_needs;
        shown->show_environment(
            {.count = in.count(),
             .normal = in.vec3(0),
             .to_observer = in.vec3(3),
             .tangent = needs.tangent ? in.vec3(6) : candela::ConstVec3Span{},
             .color = {1, 1, 1},
             .position = in.vec3(18),
             .uv = needs.uv ? candela::ConstVec2Span{in[33], in[34]} : candela::ConstVec2Span{}},
            furnace, {.ambient = out.vec3(0), .diffuse = out.vec3(3), .specular = out.vec3(6)});
        for (std::size_t i = 0; i < in.count(); ++i) {
            const float seen = largest(out.at(6, i));
            if (seen > 1.001f)
                FAIL("surrounded by 1, it shows " << seen << ", for " << text_of_input(in, i) << ", with "
                                                  << values.text);
        }
    }
}
