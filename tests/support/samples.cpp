#include "support/samples.h"

#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch_test_macros.hpp>

#include "support/plugins.h"

using candela::Vec3;
using candela::Vec3Arrays;

namespace {

template <class Samples, class Member>
Vec3Arrays column(const Samples& samples, Member member) {
    Vec3Arrays arrays;
    arrays.resize(samples.size());
    for (std::size_t i = 0; i < samples.size(); ++i) arrays.span().set(i, samples[i].*member);
    return arrays;
}

Vec3Arrays zeros(std::size_t count) {
    Vec3Arrays arrays;
    arrays.resize(count);
    return arrays;
}

}  // namespace

void each_way(const std::function<void(std::size_t)>& check) {
    const candela::InstructionSet before = candela::instruction_set();
    for (const candela::InstructionSet set : machine_instruction_sets()) {
        REQUIRE(candela::use_instruction_set(set));
        for (const std::size_t size : k_batch_sizes) {
            INFO("instruction set " << candela::name_of(set) << ", batch of " << size);
            check(size);
        }
    }
    candela::use_instruction_set(before);
}

Vec3 Random::direction() {
    for (;;) {
        const Double3 v{number(-1, 1), number(-1, 1), number(-1, 1)};
        if (length(v) > 0.1 && length(v) <= 1) {
            const Double3 u = unit(v);
            return {static_cast<float>(u.x), static_cast<float>(u.y), static_cast<float>(u.z)};
        }
    }
}

Vec3 Random::point(double half_size) {
    const auto x = [&] { return static_cast<float>(number(-half_size, half_size)); };
    return {x(), x(), x()};
}

std::vector<ReflectedPair> reflect(const candela::ReflectionModel& model,
                                   const std::vector<ReflectionSample>& samples, candela::Rgb color) {
    const Vec3Arrays normal = column(samples, &ReflectionSample::normal);
    const Vec3Arrays to_observer = column(samples, &ReflectionSample::to_observer);
    const Vec3Arrays to_light = column(samples, &ReflectionSample::to_light);
    const Vec3Arrays light_diffuse = column(samples, &ReflectionSample::diffuse);
    const Vec3Arrays light_specular = column(samples, &ReflectionSample::specular);
    Vec3Arrays ambient = zeros(samples.size()), diffuse = zeros(samples.size()),
               specular = zeros(samples.size());
    Vec3Arrays tangent = zeros(samples.size());
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const Double3 t = tangent_at(exact(samples[i].normal));
        tangent.span().set(i, {static_cast<float>(t.x), static_cast<float>(t.y), static_cast<float>(t.z)});
    }
    model.reflect(
        {samples.size(), normal.span(), to_observer.span(), candela::ConstVec3Span(tangent.span()), color},
        {to_light.span(), light_diffuse.span(), light_specular.span()},
        {ambient.span(), diffuse.span(), specular.span()});
    std::vector<ReflectedPair> result;
    for (std::size_t i = 0; i < samples.size(); ++i)
        result.push_back({diffuse.span()[i], specular.span()[i]});
    return result;
}

Double3 tangent_at(Double3 normal) {
    const Double3 aside = std::abs(normal.y) < 0.9 ? Double3{0, 1, 0} : Double3{1, 0, 0};
    return unit(cross(aside, normal));
}

std::vector<Vec3> reflect_ambient(const candela::ReflectionModel& model,
                                  const std::vector<ReflectionSample>& samples, candela::Rgb color,
                                  Vec3 intensity) {
    const Vec3Arrays normal = column(samples, &ReflectionSample::normal);
    const Vec3Arrays to_observer = column(samples, &ReflectionSample::to_observer);
    Vec3Arrays light = zeros(samples.size());
    for (std::size_t i = 0; i < samples.size(); ++i) light.span().set(i, intensity);
    Vec3Arrays ambient = zeros(samples.size()), diffuse = zeros(samples.size()),
               specular = zeros(samples.size());
    model.reflect_ambient({samples.size(), normal.span(), to_observer.span(), {}, color}, light.span(),
                          {ambient.span(), diffuse.span(), specular.span()});
    std::vector<Vec3> result;
    for (std::size_t i = 0; i < samples.size(); ++i) result.push_back(ambient.span()[i]);
    return result;
}

void check_reflection(const candela::ReflectionModel& model, const ReflectionReference& reference,
                      double tolerance) {
    constexpr candela::Rgb k_color{0.8f, 0.5f, 0.25f};
    each_way([&](std::size_t size) {
        Random random(static_cast<unsigned>(size));
        std::vector<ReflectionSample> samples;
        for (std::size_t i = 0; i < size; ++i) {
            // The observer is on the surface's side; the light may be anywhere.
            const Vec3 n = random.direction();
            Vec3 v = random.direction();
            if (dot(n, v) < 0) v = -v;
            samples.push_back({n, v, random.direction(), {1, 2, 0.5f}, {0.5f, 1, 3}});
        }
        const auto batch = reflect(model, samples, k_color);
        for (std::size_t i = 0; i < size; ++i) {
            const ReflectionSample& s = samples[i];
            INFO("sample " << i << ": N " << text(s.normal) << " V " << text(s.to_observer) << " L "
                           << text(s.to_light));
            const ExactPair expected = reference(exact(s.normal), exact(s.to_observer), exact(s.to_light),
                                                 {k_color.r, k_color.g, k_color.b});
            const Double3 d{expected.diffuse.x * s.diffuse.x, expected.diffuse.y * s.diffuse.y,
                            expected.diffuse.z * s.diffuse.z};
            const Double3 h{expected.specular.x * s.specular.x, expected.specular.y * s.specular.y,
                            expected.specular.z * s.specular.z};
            INFO("diffuse " << text(batch[i].diffuse) << ", expected " << text(d) << "; specular "
                            << text(batch[i].specular) << ", expected " << text(h));
            REQUIRE(agree(batch[i].diffuse, d, tolerance));
            REQUIRE(agree(batch[i].specular, h, tolerance));
            const auto single = reflect(model, {s}, k_color);
            REQUIRE(agree(single[0].diffuse, batch[i].diffuse, 1e-5));
            REQUIRE(agree(single[0].specular, batch[i].specular, 1e-5));
        }
    });
}

std::vector<IncidentSample> illuminate(const candela::Light& light, const std::vector<Vec3>& positions,
                                       Vec3 normal) {
    Vec3Arrays position = zeros(positions.size()), normals = zeros(positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i) {
        position.span().set(i, positions[i]);
        normals.span().set(i, normal);
    }
    Vec3Arrays to_light = zeros(positions.size()), diffuse = zeros(positions.size()),
               specular = zeros(positions.size());
    light.illuminate(0, {positions.size(), position.span(), normals.span()},
                     {to_light.span(), diffuse.span(), specular.span()});
    std::vector<IncidentSample> result;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        result.push_back({to_light.span()[i], diffuse.span()[i], specular.span()[i]});
    }
    return result;
}

std::vector<Vec3> illuminate_ambient(const candela::Light& light, const std::vector<Vec3>& positions) {
    Vec3Arrays position = zeros(positions.size()), normals = zeros(positions.size()),
               ambient = zeros(positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i) position.span().set(i, positions[i]);
    light.illuminate_ambient({positions.size(), position.span(), normals.span()}, ambient.span());
    std::vector<Vec3> result;
    for (std::size_t i = 0; i < positions.size(); ++i) result.push_back(ambient.span()[i]);
    return result;
}

void check_light(const candela::Light& light, const LightReference& reference, double tolerance) {
    each_way([&](std::size_t size) {
        Random random(static_cast<unsigned>(size));
        std::vector<Vec3> positions;
        for (std::size_t i = 0; i < size; ++i) positions.push_back(random.point(5));
        const auto batch = illuminate(light, positions);
        for (std::size_t i = 0; i < size; ++i) {
            INFO("point " << text(positions[i]));
            const ExactIncident expected = reference(exact(positions[i]));
            INFO("L " << text(batch[i].to_light) << ", expected " << text(expected.to_light));
            INFO("intensity " << text(batch[i].diffuse) << ", expected " << text(expected.intensity));
            REQUIRE(agree(batch[i].to_light, expected.to_light, tolerance, 1e-6));
            REQUIRE(agree(batch[i].diffuse, expected.intensity, tolerance, 1e-6));
            REQUIRE(batch[i].specular == batch[i].diffuse);
            const auto single = illuminate(light, {positions[i]});
            REQUIRE(agree(single[0].to_light, batch[i].to_light, 1e-5));
            REQUIRE(agree(single[0].diffuse, batch[i].diffuse, 1e-5));
        }
    });
}

bool agree(double a, double b, double relative, double absolute) {
    return std::abs(a - b) <= std::max(absolute, relative * std::max(std::abs(a), std::abs(b)));
}

bool agree(Vec3 a, Vec3 b, double relative, double absolute) {
    return agree(a, exact(b), relative, absolute);
}

bool agree(Vec3 a, Double3 b, double relative, double absolute) {
    return agree(a.x, b.x, relative, absolute) && agree(a.y, b.y, relative, absolute) &&
           agree(a.z, b.z, relative, absolute);
}

std::string text(Vec3 v) { return fmt::format("({}, {}, {})", v.x, v.y, v.z); }
std::string text(Double3 v) { return fmt::format("({}, {}, {})", v.x, v.y, v.z); }
