#include "metallic_roughness.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

#include "candela/target/renderers.h"

namespace candela::gltf_target {

namespace {

bool is_metallic_roughness(const ExportedReflection& model) {
    return std::string_view(model.id) == "reflection/metallic-roughness";
}

/// An extension of a material: the entries that differ from its defaults.
class Extension {
  public:
    Extension(const ExportedReflection& model, const ExportedValues& values)
        : model_(model), values_(values) {}

    void number(const char* key, const char* parameter, float usual) {
        const float value = target::real_value(model_, values_, parameter).value_or(usual);
        if (value != usual) entries_[key] = value;
    }
    void color(const char* key, const char* parameter, float usual) {
        const Vec3 value = target::rgb_value(model_, values_, parameter).value_or(Vec3{usual, usual, usual});
        if (value != Vec3{usual, usual, usual}) entries_[key] = {value.x, value.y, value.z};
    }
    void add_to(Json& material, const char* name, Document& document) {
        if (entries_.empty()) return;
        material["extensions"][name] = std::move(entries_);
        document.use_extension(name);
    }

  private:
    const ExportedReflection& model_;
    const ExportedValues& values_;
    Json entries_ = Json::object();
};

/// KHR_materials_specular: a dielectric with an infinite index of refraction, which glTF writes as 0.
Json specular_glossiness_material(const ExportedReflection& model, const ExportedValues& values, Vec3 color,
                                  Document& document) {
    const float glossiness = target::real_value(model, values, "glossiness").value_or(0.0f);
    Json material = {{"pbrMetallicRoughness",
                      {{"baseColorFactor", {color.x, color.y, color.z, 1}},
                       {"metallicFactor", 0},
                       {"roughnessFactor", 1 - glossiness}}}};
    material["extensions"]["KHR_materials_ior"]["ior"] = 0;
    document.use_extension("KHR_materials_ior");
    Extension specular(model, values);
    specular.color("specularColorFactor", "specular_color", 1);
    specular.add_to(material, k_specular, document);
    return material;
}

}  // namespace

std::optional<Json> metallic_roughness_material(const ExportedReflection& model, const ExportedValues& values,
                                                Vec3 color, Document& document) {
    if (std::string_view(model.id) == "reflection/specular-glossiness")
        return specular_glossiness_material(model, values, color, document);
    if (!is_metallic_roughness(model)) return std::nullopt;
    const auto real = [&](const char* parameter) {
        return target::real_value(model, values, parameter).value_or(0.0f);
    };
    Json material = {{"pbrMetallicRoughness",
                      {{"baseColorFactor", {color.x, color.y, color.z, 1}},
                       {"metallicFactor", real("metallic")},
                       {"roughnessFactor", real("roughness")}}}};

    Extension ior(model, values), specular(model, values);
    ior.number("ior", "ior", 1.5f);
    ior.add_to(material, "KHR_materials_ior", document);
    specular.number("specularFactor", "specular", 1);
    specular.color("specularColorFactor", "specular_color", 1);
    specular.add_to(material, k_specular, document);
    if (real("clearcoat") > 0) {
        Extension coat(model, values);
        coat.number("clearcoatFactor", "clearcoat", 0);
        coat.number("clearcoatRoughnessFactor", "clearcoat_roughness", 0);
        coat.add_to(material, "KHR_materials_clearcoat", document);
    }
    if (target::rgb_value(model, values, "sheen_color").value_or(Vec3{}) != Vec3{}) {
        Extension sheen(model, values);
        sheen.color("sheenColorFactor", "sheen_color", 0);
        sheen.number("sheenRoughnessFactor", "sheen_roughness", 0);
        sheen.add_to(material, "KHR_materials_sheen", document);
    }
    if (is_anisotropic(model, values)) {
        Extension anisotropy(model, values);
        anisotropy.number("anisotropyStrength", "anisotropy_strength", 0);
        anisotropy.number("anisotropyRotation", "anisotropy_rotation", 0);
        anisotropy.add_to(material, "KHR_materials_anisotropy", document);
    }
    if (real("iridescence") > 0) {
        Extension film(model, values);
        film.number("iridescenceFactor", "iridescence", 0);
        film.number("iridescenceIor", "iridescence_ior", 1.3f);
        film.number("iridescenceThicknessMaximum", "iridescence_thickness", 400);
        film.add_to(material, "KHR_materials_iridescence", document);
    }
    return material;
}

bool is_anisotropic(const ExportedReflection& model, const ExportedValues& values) {
    return is_metallic_roughness(model) &&
           target::real_value(model, values, "anisotropy_strength").value_or(0.0f) > 0;
}

}  // namespace candela::gltf_target
