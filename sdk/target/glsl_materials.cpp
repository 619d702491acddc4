#include "glsl_materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "candela/target/files.h"
#include "candela/target/glsl.h"
#include "candela/target/kernels.h"
#include "candela/target/literals.h"

namespace candela::target {

namespace {

std::size_t most_pictures(const ExportedScene& scene) {
    std::size_t most = 0;
    for (const ExportedObject& object : scene.objects)
        most = std::max(most, material_pictures(object).size());
    return most;
}

std::string row(const float (&placing)[6], std::size_t first) {
    return fmt::format("vec3({}, {}, {})", float_text(placing[first]), float_text(placing[first + 1]),
                       float_text(placing[first + 2]));
}

std::string finite(float x) {
    constexpr float k_largest = std::numeric_limits<float>::max();
    return float_text(std::clamp(x, -k_largest, k_largest));
}

std::string text_of(const ExportedScene& scene, const ExportedObject& object) {
    if (object.textured_numbers.empty()) return "";
    const std::vector<MaterialPicture> pictures = material_pictures(object);
    const ExportedReflection& model = scene.reflections[object.reflection];
    constexpr const char* k_channels[] = {".x", ".y", ".z"};
    std::string texels, sets;
    std::vector<std::string> lookups;
    for (const ExportedTexturedNumber& n : object.textured_numbers) {
        const auto slot =
            std::ranges::find(pictures, MaterialPicture{n.texture, n.repeats}) - pictures.begin();
        const std::string lookup = fmt::format("material_texel(material_texture_{}, {}, {})", slot,
                                               row(n.placing, 0), row(n.placing, 3));
        const auto known = std::ranges::find(lookups, lookup);
        const auto place = known - lookups.begin();
        if (known == lookups.end()) {
            texels += fmt::format("    vec3 texel_{} = {};\n", place, lookup);
            lookups.push_back(lookup);
        }
        const ParamSpec& parameter = model.plugin->parameters[n.parameter];
        sets += fmt::format("    own_material.{}{} = number_of(texel_{}{}, {}, {}, {}, {});\n",
                            parameter.name, parameter.type == ParamType::real ? "" : k_channels[n.channel],
                            place, k_channels[n.texel_channel], float_text(n.scale), float_text(n.offset),
                            finite(n.minimum), finite(n.maximum));
    }
    return fmt::format(
        "vec3 material_texel(ColorTexture t, vec3 u, vec3 v);\n"
        "float number_of(float texel, float scale, float offset, float low, float high) {{\n"
        "    return min(max(offset + scale * texel, low), high);\n}}\n"
        "// {}: textures give some numbers of its material.\n"
        "void find_material() {{\n    own_material = material;\n{}{}}}\n",
        ascii_identifier(object.label), texels, sets);
}

}  // namespace

std::vector<MaterialPicture> material_pictures(const ExportedObject& object) {
    std::vector<MaterialPicture> pictures;
    for (const ExportedTexturedNumber& n : object.textured_numbers) {
        const MaterialPicture one{n.texture, n.repeats};
        if (std::ranges::find(pictures, one) == pictures.end()) pictures.push_back(one);
    }
    return pictures;
}

bool has_textured_materials(const ExportedScene& scene) {
    return std::ranges::any_of(scene.objects, [](const auto& o) { return !o.textured_numbers.empty(); });
}

std::vector<std::string> textured_materials(const ExportedScene& scene) {
    std::vector<std::string> all;
    for (const ExportedObject& object : scene.objects) {
        if (material_pictures(object).size() > k_most_material_pictures)
            throw std::runtime_error(
                fmt::format("the material of object {} reads {} pictures; shaders have room for {}",
                            object.label, material_pictures(object).size(), k_most_material_pictures));
        all.push_back(text_of(scene, object));
    }
    return all;
}

std::string material_units(const ExportedScene& scene) {
    const std::size_t count = most_pictures(scene);
    if (count == 0) return "";
    std::string declarations, choices;
    for (std::size_t i = 0; i < count; ++i) {
        declarations += fmt::format(
            "uniform highp usampler2D material_texels_{0};\nuniform ColorTexture material_texture_{0};\n", i);
        choices +=
            fmt::format("    if (unit == {}) return texelFetch(material_texels_{}, at, 0);\n", i + 1, i);
    }
    return fmt::format(
        "{}uvec4 texel_of_unit(int unit, ivec2 at) {{\n{}    return texelFetch(color_texels, at, 0);\n}}\n",
        declarations, choices);
}

}  // namespace candela::target
