#include "candela/target/renderers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace candela::target {

namespace {

Vector vector(Vec3 v) { return {v.x, v.y, v.z}; }

Vector cross(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Vector unit(const Vector& a) {
    const double length = std::hypot(a[0], a[1], a[2]);
    return {a[0] / length, a[1] / length, a[2] / length};
}

const ParamValue* value_named(const ExportedModel& model, const ExportedValues& values,
                              std::string_view parameter, ParamType type) {
    const auto& parameters = model.plugin->parameters;
    for (std::size_t i = 0; i < parameters.size() && i < values.runtime.size(); ++i)
        if (parameter == parameters[i].name && parameters[i].type == type) return &values.runtime[i];
    return nullptr;
}

/// The common value for both directions, or their geometric mean.
std::optional<float> mean_value(const ExportedModel& model, const ExportedValues& values,
                                std::string_view both, std::string_view along, std::string_view across) {
    if (const auto value = real_value(model, values, both)) return value;
    const auto u = real_value(model, values, along), v = real_value(model, values, across);
    if (!u || !v) return std::nullopt;
    return std::sqrt(std::max(*u, 0.0f) * std::max(*v, 0.0f));
}

/// Whether the normal is the one interpolated between the vertices.
bool is_interpolated(const ExportedShading& shading) {
    const ShadingNeeds& needs = shading.needs;
    return shading.rate == ShadingRate::fragment && needs.vertex_normal && !needs.face_normal &&
           !needs.barycentric && !needs.uv && !needs.derivatives && !needs.triangle;
}

}  // namespace

ViewAxes axes_of(const ExportedObserver& observer) {
    const Vector from = vector(observer.position), to = vector(observer.look_at);
    const Vector backward = unit({from[0] - to[0], from[1] - to[1], from[2] - to[2]});
    const Vector right = unit(cross(vector(observer.up), backward));
    return {.right = right, .up = cross(backward, right), .backward = backward};
}

std::optional<Vec3> rgb_value(const ExportedModel& model, const ExportedValues& values,
                              std::string_view parameter) {
    const ParamValue* value = value_named(model, values, parameter, ParamType::rgb);
    if (value == nullptr) value = value_named(model, values, parameter, ParamType::color);
    if (value == nullptr) return std::nullopt;
    return Vec3{value->number[0], value->number[1], value->number[2]};
}

std::optional<float> real_value(const ExportedModel& model, const ExportedValues& values,
                                std::string_view parameter) {
    const ParamValue* const value = value_named(model, values, parameter, ParamType::real);
    if (value == nullptr) return std::nullopt;
    return value->number[0];
}

std::optional<Highlight> highlight_of(const ExportedModel& model, const ExportedValues& values) {
    if (std::string_view(model.id) == "reflection/specular-glossiness") {
        const float rough = 1 - real_value(model, values, "glossiness").value_or(0);
        return Highlight{.specular = rgb_value(model, values, "specular_color").value_or(Vec3{}),
                         .alpha = std::clamp(rough * rough, 1e-3f, 1.0f),
                         .facets = 1};
    }
    const auto specular = rgb_value(model, values, "ks");
    if (!specular) return std::nullopt;
    const auto alpha = mean_value(model, values, "roughness", "roughness_u", "roughness_v");
    const auto exponent = mean_value(model, values, "shininess", "exponent_u", "exponent_v");
    if (!alpha && !exponent) return std::nullopt;
    Highlight result{.specular = *specular,
                     .alpha = alpha ? std::clamp(*alpha, 1e-3f, 1.0f) : std::sqrt(2 / (*exponent + 2))};
    if (!alpha) return result;
    // An index of 100 means that the highlight is ks without a Fresnel factor, which is how models are
    // imported.
    constexpr float k_constant = 100;
    const float ior = real_value(model, values, "ior").value_or(k_constant);
    const float mirrored = ior < k_constant ? (ior - 1) / (ior + 1) : 1;
    result.facets = mirrored * mirrored;
    return result;
}

std::optional<Principled> principled_of(const ExportedModel& model, const ExportedValues& values) {
    const std::string_view id = model.id;
    const auto real = [&](const char* parameter, float otherwise) {
        return real_value(model, values, parameter).value_or(otherwise);
    };
    const float roughness = real("roughness", 1), alpha = std::clamp(roughness * roughness, 1e-3f, 1.0f);
    if (id == "reflection/disney") {
        return Principled{
            .metallic = real("metallic", 0), .alpha = alpha, .reflectance = 0.08f * real("specular", 0.5f)};
    }
    const bool is_openpbr = id == "reflection/openpbr";
    if (!is_openpbr && id != "reflection/metallic-roughness") return std::nullopt;
    const float ior = real(is_openpbr ? "specular_ior" : "ior", 1.5f);
    const float facets = (ior - 1) / (ior + 1) * ((ior - 1) / (ior + 1));
    const Vec3 color = rgb_value(model, values, "specular_color").value_or(Vec3{1, 1, 1});
    const float tint = (color.x + color.y + color.z) / 3;
    if (is_openpbr) {
        const float rough = real("specular_roughness", 0.3f), weight = real("specular_weight", 1);
        return Principled{.base = real("base_weight", 1) *
                                  rgb_value(model, values, "base_color").value_or(Vec3{0.8f, 0.8f, 0.8f}),
                          .metallic = real("base_metalness", 0),
                          .alpha = std::clamp(rough * rough, 1e-3f, 1.0f),
                          .reflectance = std::min(weight * facets, 1.0f) * tint};
    }
    const float strength = real("anisotropy_strength", 0);
    const float along = alpha + (1 - alpha) * strength * strength;
    return Principled{.metallic = real("metallic", 0),
                      .alpha = std::sqrt(alpha * along),
                      .reflectance = real("specular", 1) * std::min(facets * tint, 1.0f)};
}

void approximate_shading(const ExportedShading& shading, FileSink& files) {
    const auto say = [&](const char* how) {
        files.approximate(fmt::format("{} {}", shading.id, how).c_str());
    };
    if (shading.rate == ShadingRate::face)
        return say("is lit at each point of a face, not once for all of it");
    if (shading.rate == ShadingRate::vertex) return say("is lit at each point, not at the vertices");
    if (!is_interpolated(shading)) say("becomes that of normals interpolated between the vertices");
}

}  // namespace candela::target
