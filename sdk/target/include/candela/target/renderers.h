// For targets that write scenes of renderers, which have models of their own.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "candela/target.h"

namespace candela::target {

using Vector = std::array<double, 3>;

/// Unit vectors of the observer's view, perpendicular to each other: right-handed, looking along -backward.
struct ViewAxes {
    Vector right{}, up{}, backward{};
};
ViewAxes axes_of(const ExportedObserver& observer);

/// Channel by channel.
constexpr Vec3 times(Vec3 a, Vec3 b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }

/// A parameter by its name, as an instance receives it: a colour or coefficient of three channels, or one
/// number. Nothing where the model has none of that name and kind.
std::optional<Vec3> rgb_value(const ExportedModel& model, const ExportedValues& values,
                              std::string_view parameter);
std::optional<float> real_value(const ExportedModel& model, const ExportedValues& values,
                                std::string_view parameter);

/// How the highlight of a material looks, whatever its model, from the names that models give their
/// parameters: `shininess` or `exponent_u` and `exponent_v`, `roughness` or `roughness_u` and `roughness_v`,
/// `ior`, `ks`. Nothing where it has none.
struct Highlight {
    Vec3 specular{};  // ks
    float alpha =
        1;  // roughness of facets, as Beckmann's m and GGX have it; of Blinn-Phong's exponent n it is
            // sqrt(2 / (n + 2)): Walter et al. (2007), "Microfacet models for refraction", section 5.2
    float facets = 0;  // what facets mirror at normal incidence; 0: the model has no facets, and `specular`
                       // is the highlight's peak
};
std::optional<Highlight> highlight_of(const ExportedModel& model, const ExportedValues& values);

/// Says how a shading model differs from what renderers do, which is to light each point with the face's
/// normal where a model lights faces, and elsewhere with the one interpolated between the vertices.
void approximate_shading(const ExportedShading& shading, FileSink& files);

}  // namespace candela::target
