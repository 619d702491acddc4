// Requirements for reflection models that say how wide their highlight is.
#include <algorithm>
#include <array>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "batch.h"
#include "candela/kernel/kernel.h"
#include "subject.h"

import candela.api;

namespace candela::kernel {

namespace {

/// A light of intensity 1 in all directions.
struct RadianceMap {
    float density;
};
CANDELA_KERNEL_INLINE int radiance_size(RadianceMap, int) { return 1; }
CANDELA_KERNEL_INLINE int radiance_last_level(RadianceMap) { return 0; }
CANDELA_KERNEL_INLINE vec3 radiance_in_level(RadianceMap, int, vec2) { return vec3(1.0f); }
CANDELA_KERNEL_INLINE vec3 radiance_at(RadianceMap, vec2, float) { return vec3(1.0f); }

#if !defined(__cpp_aggregate_paren_init)
#define MirrorSample(...) \
    MirrorSample { __VA_ARGS__ }
#endif
#include "candela/kernel/mirror.kernel"

}  // namespace

}  // namespace candela::kernel

namespace {

using candela::ReflectionModel;
using candela::Vec3;
namespace kernel = candela::kernel;

constexpr Vec3 k_up{0, 1, 0};

/// A direction of light, and the intensity that it stands for.
struct Light {
    Vec3 towards;
    double intensity;
};

Vec3 above(double theta, double phi) {
    return {static_cast<float>(std::sin(theta) * std::cos(phi)), static_cast<float>(std::cos(theta)),
            static_cast<float>(std::sin(theta) * std::sin(phi))};
}

kernel::vec3 in_kernel(Vec3 v) { return {v.x, v.y, v.z}; }

/// All directions of light, in rings around the mirror direction.
std::vector<Light> all_around(Vec3 to_observer, int rings = 192, int spokes = 96) {
    const Vec3 mirror = 2 * dot(k_up, to_observer) * k_up - to_observer;
    const Vec3 aside =
        candela::normalized(std::abs(mirror.y) < 0.9f ? cross(k_up, mirror) : cross(Vec3{1, 0, 0}, mirror));
    const Vec3 across = cross(mirror, aside);
    const double nearest = std::log(1e-5), step = (std::log(std::numbers::pi) - nearest) / rings;
    std::vector<Light> lights;
    for (int ring = 0; ring < rings; ++ring) {
        const double angle = std::exp(nearest + (ring + 0.5) * step);
        for (int spoke = 0; spoke < spokes; ++spoke) {
            const double phi = 2 * std::numbers::pi * (spoke + 0.5) / spokes;
            const Vec3 l = static_cast<float>(std::cos(angle)) * mirror +
                           static_cast<float>(std::sin(angle) * std::cos(phi)) * aside +
                           static_cast<float>(std::sin(angle) * std::sin(phi)) * across;
            if (l.y > 0)
                lights.push_back({candela::normalized(l), 2 * std::sin(angle) * angle * step / spokes});
        }
    }
    return lights;
}

class Highlights {
  public:
    explicit Highlights(const Values& values) : model_(make<ReflectionModel>(values)) {}

    const candela::GlossyReflection* glossy() const {
        return candela::extension_of<candela::GlossyReflection>(*model_);
    }

    float width(Vec3 to_observer) const {
        const Arrays in = inputs(to_observer, {{k_up, 0}});
        Arrays out(1, 1);
        glossy()->highlight_widths(surface(in), out[0]);
        return out[0][0];
    }

    /// Whether turning the surface about its normal changes nothing: a width has no direction.
    bool is_isotropic() const {
        const Vec3 v = above(0.6, 0.7);
        for (const Light& light : all_around(v, 12, 8)) {
            const double before = of(v, {light}), after = of(v, {light}, {0.6f, 0, 0.8f});
            if (std::abs(before - after) > 0.001 * std::abs(before)) return false;
        }
        return true;
    }

    /// The light that the highlight reflects, as the mean of its channels.
    double of(Vec3 to_observer, const std::vector<Light>& lights, Vec3 tangent = {1, 0, 0}) const {
        const Arrays in = inputs(to_observer, lights, tangent);
        Arrays out(9, lights.size());
        model_->reflect(surface(in),
                        {.to_light = in.vec3(9), .diffuse = in.vec3(12), .specular = in.vec3(15)},
                        {.ambient = out.vec3(0), .diffuse = out.vec3(3), .specular = out.vec3(6)});
        double sum = 0;
        for (std::size_t i = 0; i < lights.size(); ++i) {
            const Vec3 reflected = out.at(6, i);
            sum += double{reflected.x + reflected.y + reflected.z} / 3;
        }
        return sum;
    }

  private:
    static Arrays inputs(Vec3 to_observer, const std::vector<Light>& lights, Vec3 tangent = {1, 0, 0}) {
        Arrays in(21, lights.size());
        for (std::size_t i = 0; i < lights.size(); ++i) {
            const auto intensity = static_cast<float>(lights[i].intensity);
            in.vec3(0).set(i, k_up);
            in.vec3(3).set(i, to_observer);
            in.vec3(6).set(i, tangent);
            in.vec3(9).set(i, lights[i].towards);
            in.vec3(12).set(i, {0, 0, 0});
            in.vec3(15).set(i, {intensity, intensity, intensity});
            in.vec3(18).set(i, {0.1f, 0.2f, 0.3f});
        }
        return in;
    }

    static candela::SurfaceBatch surface(const Arrays& in) {
        const candela::SurfaceNeeds& needs = subject().surface_needs;
        return {.count = in.count(),
                .normal = in.vec3(0),
                .to_observer = in.vec3(3),
                .tangent = needs.tangent ? in.vec3(6) : candela::ConstVec3Span{},
                .color = {0.9f, 0.9f, 0.9f},
                .position = in.vec3(18),
                .uv = needs.uv ? candela::ConstVec2Span{in[18], in[19]} : candela::ConstVec2Span{}};
    }

    std::unique_ptr<ReflectionModel> model_;
};

/// The directions in which a renderer looks for light from everywhere.
std::vector<Light> as_rendered(Vec3 to_observer, float width) {
    constexpr int k_samples = 256;
    const kernel::RadianceMap map{static_cast<float>(k_samples / (4 * std::numbers::pi))};
    std::vector<Light> lights;
    for (int i = 0; i < k_samples; ++i) {
        const Vec3 l = above(std::acos(1 - (2 * i + 1.0) / k_samples), 2.399963229728653 * i);
        const float share = kernel::highlight_share(map.density, in_kernel(k_up), in_kernel(to_observer),
                                                    in_kernel(l), width);
        lights.push_back({l, 4.0 / k_samples * double{share}});
    }
    for (int i = 0; i < kernel::mirror_samples(); ++i) {
        const kernel::MirrorSample sample =
            kernel::mirror_sample(map, in_kernel(k_up), in_kernel(to_observer), width, i);
        lights.push_back(
            {{sample.to_light.x, sample.to_light.y, sample.to_light.z}, double{sample.intensity.x}});
    }
    return lights;
}

}  // namespace

TEST_CASE("highlight width, if there is one: a highlight reflects the light from everywhere that it reflects",
          "[reflection]") {
    if (Highlights(default_values()).glossy() == nullptr) SKIP("it does not say how wide its highlight is");
    constexpr std::array k_degrees{5.0, 30.0, 50.0, 65.0, 75.0};
    for (const Values& values : many_values(20)) {
        const Highlights highlights(values);
        if (!highlights.is_isotropic()) continue;
        double found = 0, expected = 0;
        float width = 0;
        for (const double degrees : k_degrees) {
            const Vec3 v = above(degrees * std::numbers::pi / 180, 0.7);
            width = highlights.width(v);
            if (!std::isfinite(width) || width <= 0)
                FAIL("the width of its highlight is " << width << ", with " << values.text);
            const float bounded = std::clamp(width, 1e-4f, 1.0f);
            expected += highlights.of(v, all_around(v)) / k_degrees.size();
            found += highlights.of(v, as_rendered(v, bounded)) / k_degrees.size();
        }
        if (!(std::abs(found - expected) <= 0.15 * expected + 0.01))
            FAIL("looked for as far as its width of " << width << " says, its highlight reflects " << found
                                                      << " of light that is 1 everywhere, but " << expected
                                                      << " of all, with " << values.text);
    }
}
