// Requirements for lights, and for what they declare.
#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "batch.h"
#include "incident.h"

import candela.api;

using candela::Vec3;

namespace {

std::optional<Vec3> position_in(const Values& values) {
    const std::size_t index = values.set.index_of("position");
    if (index == values.set.schema().size() || !values.set.get(index)) return std::nullopt;
    const auto* const p = std::get_if<Vec3>(&*values.set.get(index));
    return p != nullptr ? std::optional(*p) : std::nullopt;
}

/// The total diffuse light of the tested samples at receivers that face the light.
std::vector<float> sent_to(const Values& values, const std::vector<Vec3>& points, Vec3 normal) {
    Arrays in = inputs_for(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        in.vec3(18).set(i, points[i]);
        in.vec3(0).set(i, normal);
    }
    std::vector<float> sum(points.size());
    for (const Call& call : batch_subject(values).calls) {
        if (call.name == "illuminate_ambient") continue;
        const Arrays out = outputs_of(call, in);
        for (std::size_t i = 0; i < points.size(); ++i) sum[i] += std::max({out[3][i], out[4][i], out[5][i]});
    }
    return sum;
}

constexpr float k_far = 1e5f;

/// The ratio of the light at 2 k_far to that at k_far, according to the parameters that the shipped lights
/// share (candela/light_plugin.h); nothing if the light has none of them.
std::optional<double> law_of_parameters(const Values& values) {
    const candela::ParamSet& set = values.set;
    const auto value = [&](const char* name) -> const candela::Value* {
        const std::size_t index = set.index_of(name);
        return index < set.schema().size() && set.get(index) ? &*set.get(index) : nullptr;
    };
    const candela::Value* const attenuation = value("attenuation");
    const auto* const law = attenuation != nullptr ? std::get_if<std::string>(attenuation) : nullptr;
    if (law == nullptr) return std::nullopt;
    if (*law == "none") return 1;
    if (*law == "inverse-square") return 0.25;
    const candela::Value* const offset = value("attenuation_offset");
    const auto* const k = offset != nullptr ? std::get_if<double>(offset) : nullptr;
    if (*law != "offset-linear" || k == nullptr) return std::nullopt;
    return (double{k_far} + *k) / (2 * double{k_far} + *k);
}

/// Whether a path from the point in that direction leads away from each sample of the light.
bool is_beyond_all_samples(const Values& values, Vec3 point, Vec3 direction) {
    Arrays in = inputs_for(1);
    in.vec3(18).set(0, point);
    in.vec3(0).set(0, -direction);
    for (const Call& call : batch_subject(values).calls) {
        if (call.name == "illuminate_ambient") continue;
        if (dot(outputs_of(call, in).at(0, 0), direction) > 0) return false;
    }
    return true;
}

/// Compares what a light sends with its description of itself, in double precision.
void compare_with_data(const candela::Light& light, int sample, const candela::PunctualLight& data,
                       const Arrays& in, const Values& values) {
    Arrays out(9, in.count());
    light.illuminate(
        sample,
        {.count = in.count(), .position = in.vec3(inputs::k_position), .normal = in.vec3(inputs::k_normal)},
        {.to_light = out.vec3(0), .diffuse = out.vec3(3), .specular = out.vec3(6)});
    std::size_t differing = 0, first = 0;
    for (std::size_t i = 0; i < in.count(); ++i) {
        const Vec3 p = in.at(inputs::k_position, i);
        const ExactIncident exact = incident_of(data, p);
        const auto share = static_cast<float>(exact.share);
        const Vec3 diffuse = share * Vec3{data.diffuse.r, data.diffuse.g, data.diffuse.b},
                   specular = share * Vec3{data.specular.r, data.specular.g, data.specular.b};
        const auto differ = [](Vec3 a, Vec3 b) {
            return candela::length(a - b) > 1e-4f * std::max(candela::length(a), candela::length(b)) + 1e-12f;
        };
        const bool is_off = differ(out.at(0, i), exact.to_light) || differ(out.at(3, i), diffuse) ||
                            differ(out.at(6, i), specular);
        if (is_off && differing++ == 0) first = i;
    }
    // At the edge of a hard cone, the last bit decides on which side a point is.
    constexpr double k_may_be_at_edges = 0.02;
    if (static_cast<double>(differing) > k_may_be_at_edges * static_cast<double>(in.count())) {
        const ExactIncident exact = incident_of(data, in.at(inputs::k_position, first));
        FAIL("as data, sample " << sample << " sends " << exact.share * double{data.diffuse.r}
                                << " in red; illuminate() sends " << out[3][first] << ", for "
                                << text_of_input(in, first) << " and " << differing - 1
                                << " more points, with " << values.text);
    }
}

}  // namespace

TEST_CASE("directions: the direction to the light is a unit vector, to a millionth", "[light]") {
    const Arrays in = inputs_for(1000);
    for (const Values& values : many_values()) {
        for (const Call& call : batch_subject(values).calls) {
            if (call.outputs.front() != "to_light") continue;
            const Arrays out = outputs_of(call, in);
            for (std::size_t i = 0; i < in.count(); ++i) {
                const Vec3 l = out.at(0, i);
                const double size = std::sqrt(double{l.x} * l.x + double{l.y} * l.y + double{l.z} * l.z);
                if (std::abs(size - 1) > 1e-6)
                    FAIL(call.name << " returns a direction of length " << size << ", for "
                                   << text_of_input(in, i) << ", with " << values.text);
            }
        }
    }
}

TEST_CASE("towards: from far away, the returned direction leads to the light", "[light]") {
    constexpr float k_distance = 1e5f;
    const auto vector_called = [](const Values& values, const char* name) {
        const std::size_t index = values.set.index_of(name);
        const bool is_there = index < values.set.schema().size() && values.set.get(index) &&
                              std::holds_alternative<Vec3>(*values.set.get(index));
        return is_there ? std::optional(std::get<Vec3>(*values.set.get(index))) : std::nullopt;
    };
    for (const Values& values : many_values(10)) {
        const auto position = position_in(values), direction = vector_called(values, "direction");
        if (!position && !direction) SKIP("it has neither 'position' nor 'direction'");
        for (const Vec3 d :
             {Vec3{0, -1, 0}, Vec3{0, 1, 0}, Vec3{0.6f, -0.64f, 0.48f}, Vec3{-0.48f, 0.6f, 0.64f}}) {
            Arrays in = inputs_for(1);
            in.vec3(18).set(0, position ? *position + k_distance * d : k_distance * d);
            in.vec3(0).set(0, -d);
            const Vec3 expected = -candela::normalized(position ? d : *direction);
            for (const Call& call : batch_subject(values).calls) {
                if (call.outputs.front() != "to_light") continue;
                const Arrays out = outputs_of(call, in);
                const bool is_dark = out.at(3, 0) == Vec3{} && out.at(6, 0) == Vec3{};
                const Vec3 l = out.at(0, 0);
                if (is_dark || dot(l, expected) > 0) continue;
                FAIL(call.name << " returns a light in the direction [" << l.x << ", " << l.y << ", " << l.z
                               << "], and "
                               << (position ? "its position is" : "light with that 'direction' comes from")
                               << " on the other side, for " << text_of_input(in, 0) << ", with "
                               << values.text);
            }
        }
    }
}

TEST_CASE("zero distance: a receiver at the light itself receives finite light from some direction",
          "[light]") {
    for (const Values& values : many_values()) {
        const auto position = position_in(values);
        if (!position) SKIP("it has no position");
        Arrays in = inputs_for(64);
        for (std::size_t i = 0; i < 64; ++i)
            in.vec3(18).set(i, *position + (i < 32 ? 0.0f : 1e-30f) * Vec3{1, 1, 1});
        for (const Call& call : batch_subject(values).calls) {
            const Arrays out = outputs_of(call, in);
            for (std::size_t a = 0; a < out.arrays(); ++a) {
                if (!std::isfinite(out[a][0]) || !std::isfinite(out[a][63]))
                    FAIL(call.name << " returns " << out[a][0] << " as " << call.outputs[a / 3]
                                   << " at the light's own position, with " << values.text);
            }
        }
    }
}

TEST_CASE("fall-off, as declared: constant, or never brighter farther away", "[light]") {
    const std::string law = declared("attenuation");
    if (law != "constant" && law != "by distance")
        SKIP("it declares no 'attenuation' of 'constant' or 'by distance'");
    for (const Values& values : many_values()) {
        if (law == "constant") {
            const std::vector<float> sent =
                sent_to(values, {{0, 0, 0}, {3, -2, 1}, {-100, 50, 20}}, {0, 1, 0});
            if (sent[0] != sent[1] || sent[0] != sent[2])
                FAIL("declared constant, but it sends " << sent[0] << " to one point and " << sent[2]
                                                        << " to another, with " << values.text);
            continue;
        }
        const auto position = position_in(values);
        if (!position)
            FAIL(
                "it declares attenuation by distance, but has no parameter 'position' to measure the "
                "distance from");
        const std::optional<double> expected = law_of_parameters(values);
        for (const Vec3 d : {Vec3{0, -1, 0}, Vec3{0.6f, -0.64f, 0.48f}, Vec3{-0.48f, 0.6f, 0.64f}}) {
            const std::vector<float> far =
                sent_to(values, {*position + k_far * d, *position + 2 * k_far * d}, -d);
            const double ratio = double{far[1]} / double{far[0]};
            if (far[0] > 0 && expected && !(std::abs(ratio / *expected - 1) < 0.03))
                FAIL("with its 'attenuation' it would send "
                     << *expected << " times as much to " << 2 * k_far << " m as to " << k_far
                     << " m; it sends " << ratio << " times as much, with " << values.text);
            if (far[0] > 0 && !expected && !(ratio < 0.999))
                FAIL("declared to fade with distance, but it sends "
                     << ratio << " times as much to " << 2 * k_far << " m as to " << k_far << " m, with "
                     << values.text);
            float distance = 50;
            while (distance < 1e6f && !is_beyond_all_samples(values, *position + distance * d, d))
                distance *= 2;
            const std::vector<float> sent =
                sent_to(values, {*position + distance * d, *position + 2 * distance * d}, -d);
            if (sent[1] > sent[0] * 1.001f)
                FAIL("declared to fade with distance, but it sends "
                     << sent[0] << " to " << distance << " m and " << sent[1] << " to " << 2 * distance
                     << " m, with " << values.text);
        }
    }
}

TEST_CASE("samples: their number is not negative, and a light without samples has an ambient part",
          "[light]") {
    const bool has_ambient = subject().has_ambient;
    for (const Values& values : many_values()) {
        const auto light = make<candela::Light>(values);
        if (light->sample_count() < 0)
            FAIL("sample_count() is " << light->sample_count() << ", with " << values.text);
        if (light->sample_count() == 0 && !has_ambient)
            FAIL("it sends no light at all, with " << values.text);
    }
}

TEST_CASE("data: the light's description of itself as data matches what it sends", "[light]") {
    Arrays in = inputs_for(500, 41);
    for (const Values& values : many_values()) {
        const auto light = make<candela::Light>(values);
        const auto* const uniform = candela::extension_of<candela::UniformAmbientSource>(*light);
        if (uniform != nullptr && !subject().has_ambient)
            FAIL("as data, it has an ambient part; illuminate_ambient() is not overridden");
        if (uniform != nullptr) {
            const candela::Rgb ambient = uniform->as_ambient();
            Arrays out(3, in.count());
            light->illuminate_ambient({.count = in.count(),
                                       .position = std::as_const(in).vec3(inputs::k_position),
                                       .normal = std::as_const(in).vec3(inputs::k_normal)},
                                      out.vec3(0));
            for (std::size_t i = 0; i < in.count(); ++i) {
                if (!(candela::length(out.at(0, i) - Vec3{ambient.r, ambient.g, ambient.b}) <=
                      1e-5f * candela::length(out.at(0, i))))
                    FAIL("as data, its ambient light is ["
                         << ambient.r << ", " << ambient.g << ", " << ambient.b << "]; but it sends ["
                         << out[0][i] << ", " << out[1][i] << ", " << out[2][i] << "] for "
                         << text_of_input(in, i) << ", with " << values.text);
            }
        }
        const auto* const punctual = candela::extension_of<candela::PunctualSource>(*light);
        if (punctual == nullptr) continue;
        for (int sample = 0; sample < std::min(light->sample_count(), 8); ++sample)
            compare_with_data(*light, sample, punctual->as_punctual(sample), in, values);
    }
}

TEST_CASE("distance: asked for, it is positive, and nothing else changes", "[light]") {
    constexpr float k_untouched = -7;
    constexpr std::size_t k_behind = 16;
    const Arrays in = inputs_for(100, 43);
    const candela::ReceiverBatch receivers{
        .count = in.count(), .position = in.vec3(inputs::k_position), .normal = in.vec3(inputs::k_normal)};
    for (const Values& values : many_values()) {
        const auto light = make<candela::Light>(values);
        for (int sample = 0; sample < std::min(light->sample_count(), 8); ++sample) {
            Arrays without(9, in.count()), with(9, in.count());
            std::vector<float> distance(in.count() + k_behind, k_untouched);
            std::fill_n(distance.begin(), in.count(), std::numeric_limits<float>::infinity());
            const auto illuminate = [&](Arrays& out, float* to) {
                light->illuminate(sample, receivers,
                                  {.to_light = out.vec3(0),
                                   .diffuse = out.vec3(3),
                                   .specular = out.vec3(6),
                                   .distance = to});
            };
            illuminate(without, nullptr);
            illuminate(with, distance.data());
            for (std::size_t i = 0; i < in.count(); ++i) {
                if (!(distance[i] > 0))
                    FAIL("sample " << sample << " is " << distance[i] << " m away, for "
                                   << text_of_input(in, i) << ", with " << values.text);
                for (std::size_t a = 0; a < with.arrays(); ++a) {
                    if (with[a][i] != without[a][i])
                        FAIL("sample " << sample << " sends " << with[a][i] << " instead of " << without[a][i]
                                       << " if it is asked for its distance, for " << text_of_input(in, i)
                                       << ", with " << values.text);
                }
            }
            if (std::any_of(distance.end() - k_behind, distance.end(),
                            [](float each) { return each != k_untouched; }))
                FAIL("sample " << sample << " writes distances after a batch of " << in.count() << " points");
        }
        const auto* const punctual = candela::extension_of<candela::PunctualSource>(*light);
        for (int sample = 0; punctual != nullptr && sample < std::min(light->sample_count(), 8); ++sample) {
            const candela::PunctualLight data = punctual->as_punctual(sample);
            for (const Vec3 edge : {data.extent_u, data.extent_v}) {
                if (!std::isfinite(dot(edge, edge)))
                    FAIL("as data, the extent of sample " << sample << " is not finite, with "
                                                          << values.text);
            }
        }
    }
}
