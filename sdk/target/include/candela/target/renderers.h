// For targets that write scenes for renderers, which have models of their own.
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

/// The product, channel by channel.
constexpr Vec3 times(Vec3 a, Vec3 b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }

/// A parameter by name, as an instance receives it: a colour or coefficient of three channels, or one number.
/// Nothing if the model has no such parameter.
std::optional<Vec3> rgb_value(const ExportedModel& model, const ExportedValues& values,
                              std::string_view parameter);
std::optional<float> real_value(const ExportedModel& model, const ExportedValues& values,
                                std::string_view parameter);

/// The shape of a material's highlight, whatever its model, from the usual names of parameters: `shininess`
/// or `exponent_u` and `exponent_v`, `roughness` or `roughness_u` and `roughness_v`, `ior`, `ks`. Nothing if
/// it has none.
struct Highlight {
    Vec3 specular{};  // ks
    float alpha = 1;  // roughness of facets, as in Beckmann's m and GGX; for Blinn-Phong's exponent n, sqrt(2
                      // / (n + 2)): Walter et al. (2007), "Microfacet models for refraction", section 5.2
    float facets = 0;  // reflectance of facets at normal incidence; 0: the model has no facets, and
                       // `specular` is the highlight's peak
};
std::optional<Highlight> highlight_of(const ExportedModel& model, const ExportedValues& values);

/// The parts of reflection/disney, metallic-roughness and openpbr that renderers have: a mixture of a
/// dielectric and a metal. Nothing for other models.
struct Principled {
    Vec3 base{1, 1, 1};     // a factor of the object's colour
    float metallic = 0;     // share of the metal
    float alpha = 1;        // roughness of facets, as in Highlight
    float reflectance = 0;  // of the dielectric's facets, at normal incidence
};
std::optional<Principled> principled_of(const ExportedModel& model, const ExportedValues& values);

/// Reports how a shading model differs from what renderers do: light each point with the face's normal if the
/// model lights faces, and otherwise with the normal interpolated between the vertices.
void approximate_shading(const ExportedShading& shading, FileSink& files);

}  // namespace candela::target
