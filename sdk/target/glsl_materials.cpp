#include "glsl_materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "candela/embed.h"
#include "candela/target/files.h"
#include "candela/target/glsl.h"
#include "candela/target/literals.h"
#include "candela/target/shadow_tree.h"
#include "candela/target/text_template.h"
#include "candela/target/textures.h"

CANDELA_EMBED(candela_target_texture, CANDELA_TARGET_TEMPLATES "/texture.glsl");

namespace candela::target {

namespace {

std::string row(const float (&placing)[6], std::size_t first) {
    return fmt::format("vec3({}, {}, {})", float_text(placing[first]), float_text(placing[first + 1]),
                       float_text(placing[first + 2]));
}

/// The picture of a number or a normal map.
template <class Reader>
MaterialPicture picture_of(const Reader& reader) {
    return {reader.texture, reader.wrap[0], reader.wrap[1]};
}

/// Looks up a picture of the object.
template <class Reader>
std::string texel_text(const ExportedObject& object, const Reader& reader) {
    const std::vector<MaterialPicture> pictures = material_pictures(object);
    const auto slot = std::ranges::find(pictures, picture_of(reader)) - pictures.begin();
    return fmt::format("{}material_texel(material_texture_{}, {}, {})", reader.uv == 0 ? "" : "second_", slot,
                       row(reader.placing, 0), row(reader.placing, 3));
}

/// The variable of a channel of the vertices.
std::string channel_text(std::size_t channel) {
    return fmt::format("lit_channels_{}.{}", channel / 4, "xyzw"[channel % 4]);
}

/// Looks up a number's texel, or its channel of the vertices.
std::string texel_text(const ExportedObject& object, const ExportedTexturedNumber& number) {
    if (!is_of_vertices(number)) return texel_text<ExportedTexturedNumber>(object, number);
    return channel_text(number.vertex_channel);
}

/// Declares what an object's texts read. The declarations of several texts meet in one shader.
std::string reading_text(const ExportedObject& object) {
    std::string text;
    if (needs_channels(object))
        text +=
            "#ifndef READS_CHANNELS\n#define READS_CHANNELS\n"
            "// Numbers of the vertices, where light is evaluated.\n"
            "vec4 lit_channels_0;\nvec4 lit_channels_1;\n#endif\n";
    if (!material_pictures(object).empty()) {
        text +=
            "#ifndef READS_PICTURES\n#define READS_PICTURES\n"
            "vec3 material_texel(ColorTexture t, vec3 u, vec3 v);\n";
        if (needs_channels(object))
            text +=
                "// By the second texture coordinates.\n"
                "vec3 second_material_texel(ColorTexture t, vec3 u, vec3 v);\n";
        text += "#endif\n";
    }
    return text;
}

constexpr const char* k_number_of =
    "#ifndef HAS_NUMBER_OF\n#define HAS_NUMBER_OF\n"
    "float number_of(float texel, float scale, float offset, float low, float high) {\n"
    "    return min(max(offset + scale * texel, low), high);\n}\n#endif\n";

/// `has_model`: with the object's own reflection model.
std::string text_of(const ExportedScene& scene, const ExportedObject& object, bool has_model) {
    const auto lookup = [&](const ExportedTexturedNumber& n) { return texel_text(object, n); };
    const auto [texels, assignments, common] = material_statements(
        scene, object, {"    ", "", "own_material", "own_color", "own_emission", "own_occlusion", has_model},
        lookup);
    std::string start = "    own_material = material;\n";
    if (has_common_textures(scene)) {
        start = "    start_material();\n";
        if (has_color_textures(scene)) start += "    own_color = object_color;\n";
        if (has_emission(scene)) start += "    own_emission = object_emission;\n";
        if (has_occlusion(scene)) start += "    own_occlusion = object_occlusion;\n";
    }
    return reading_text(object) + fmt::format(
                                      "{}// {}: textures give some numbers of its material.\n"
                                      "void find_material() {{\n{}{}{}{}}}\n",
                                      k_number_of, ascii_identifier(object.label), start, texels, assignments,
                                      common);
}

/// How the numbers of the vertices that an opacity reads are taken from, and put back to, the variables of
/// reading_text().
std::string opacity_channels_text(const ExportedObject& object) {
    const auto first = opacity_channel(object);
    if (!first) return "";
    if (std::ranges::none_of(object.opacity_numbers, is_of_vertices))
        return "#define OPACITY_READS_CHANNELS\n"
               "vec2 opacity_channels() { return lit_channels_0.xy; }\n"
               "void set_opacity_channels(vec2 numbers) { lit_channels_0.xy = numbers; }\n";
    const std::string number = channel_text(*first);
    return fmt::format(
        "#define OPACITY_READS_CHANNELS\n"
        "vec2 opacity_channels() {{ return vec2({0}, 0.0); }}\n"
        "void set_opacity_channels(vec2 numbers) {{ {0} = numbers.x; }}\n",
        number);
}

/// Whether it is a product that opacity_channel() does not suffice for.
bool reads_several_channels(const ExportedObject& object) {
    return std::ranges::count_if(object.opacity_numbers, reads_channels) > 1;
}

std::string opacity_text_of(const ExportedObject& object) {
    if (object.opacity_numbers.empty()) return "";
    std::string texels, product;
    for (std::size_t i = 0; i < object.opacity_numbers.size(); ++i) {
        const ExportedTexturedNumber& number = object.opacity_numbers[i];
        const std::string texel = i == 0 ? "texel" : fmt::format("texel_{}", i + 1);
        texels += fmt::format("    {} {} = {};\n", is_of_vertices(number) ? "float" : "vec3", texel,
                              texel_text(object, number));
        product += (i == 0 ? "" : " * ") + number_text(number, texel);
    }
    return reading_text(object) + opacity_channels_text(object) +
           fmt::format(
               "{}#define TEXTURED_OPACITY\n"
               "// {}: a texture gives its opacity.\n"
               "float textured_opacity() {{\n{}    return {};\n}}\n",
               k_number_of, ascii_identifier(object.label), texels, product);
}

std::string normal_text_of(const ExportedObject& object, NormalScale normal_scale) {
    if (object.normal_map == nullptr) return "";
    const ExportedNormalMap& map = *object.normal_map;
    const bool is_uniform = normal_scale == NormalScale::uniform;
    const char* const factor = is_uniform ? "normal_scale * " : "";
    return reading_text(object) +
           fmt::format(
               "#define NORMAL_MAPPED\n{}"
               "// {}: a picture tilts its normals.\n"
               "vec3 mapped_normal(vec3 n, ShadingPoint p) {{\n"
               "    vec3 texel = {};\n"
               "    return {}(texel, {}vec2({}, {}), {}vec2({}, {}), n, p.dpdu, p.dpdv);\n}}\n",
               is_uniform ? "uniform float normal_scale;\n" : "", ascii_identifier(object.label),
               texel_text(object, map), normal_function(map), factor, float_text(map.to_uv[0]),
               float_text(map.to_uv[1]), factor, float_text(map.to_uv[2]), float_text(map.to_uv[3]));
}

}  // namespace

std::vector<MaterialPicture> material_pictures(const ExportedObject& object) {
    std::vector<MaterialPicture> pictures;
    const auto add = [&](const MaterialPicture& one) {
        if (std::ranges::find(pictures, one) == pictures.end()) pictures.push_back(one);
    };
    const auto add_number = [&](const ExportedTexturedNumber& number) {
        if (!is_of_vertices(number)) add(picture_of(number));
    };
    std::ranges::for_each(all_textured_numbers(object), add_number);
    std::ranges::for_each(object.opacity_numbers, add_number);
    if (object.normal_map != nullptr) add(picture_of(*object.normal_map));
    return pictures;
}

std::size_t most_material_pictures(const ExportedScene& scene) {
    std::size_t most = 0;
    for (const ExportedObject& object : scene.objects)
        most = std::max(most, material_pictures(object).size());
    return most;
}

std::vector<std::string> textured_materials(const ExportedScene& scene) {
    std::vector<std::string> all;
    for (const ExportedObject& object : scene.objects) {
        if (material_pictures(object).size() > k_most_material_pictures)
            throw std::runtime_error(
                fmt::format("the material of object {} reads {} pictures; shaders have room for {}",
                            object.label, material_pictures(object).size(), k_most_material_pictures));
        all.push_back(all_textured_numbers(object).empty() ? "" : text_of(scene, object, true));
    }
    return all;
}

std::vector<std::string> textured_opacities(const ExportedScene& scene) {
    std::vector<std::string> all;
    const bool has_slower_rates = std::ranges::any_of(
        scene.shadings, [](const auto& model) { return model.rate != ShadingRate::fragment; });
    for (const ExportedObject& object : scene.objects) {
        all.push_back(opacity_text_of(object));
        if (has_slower_rates && reads_several_channels(object))
            throw std::runtime_error(fmt::format(
                "the opacity of object {} is a product of several numbers of its vertices, which shaders "
                "read only "
                "where light is evaluated for each fragment; use shading \"phong\" for all objects",
                object.label));
        if (scene.has_shadows && object.casts_shadows && object.opacity_numbers.size() > 1)
            throw std::runtime_error(fmt::format(
                "the shadows of shaders do not read the opacity of object {}, which is a product; set "
                "casts_shadows = false, or draw the scene with --no-shadows",
                object.label));
    }
    return all;
}

std::vector<std::string> normal_map_texts(const ExportedScene& scene, NormalScale normal_scale) {
    std::vector<std::string> all;
    for (const ExportedObject& object : scene.objects) all.push_back(normal_text_of(object, normal_scale));
    return all;
}

std::vector<std::string> textured_common_materials(const ExportedScene& scene) {
    std::vector<std::string> all;
    for (const ExportedObject& object : scene.objects)
        all.push_back(has_common_textures(object) ? text_of(scene, object, false) : "");
    return all;
}

bool has_common_textures(const ExportedScene& scene) {
    return std::ranges::any_of(scene.objects,
                               [](const ExportedObject& object) { return has_common_textures(object); });
}

std::string common_material(const ExportedScene& scene) {
    const bool is_textured = has_common_textures(scene);
    std::string text = "uniform vec3 object_color;\n";
    const auto declare_own = [&](const char* type, const char* name) {
        text += is_textured ? fmt::format(
                                  "#ifdef TEXTURED_MATERIAL\n{0} own_{1};\n#else\n#define own_{1} "
                                  "object_{1}\n#endif\n",
                                  type, name)
                            : fmt::format("#define own_{0} object_{0}\n", name);
    };
    const auto declare = [&](const char* type, const char* name) {
        text += fmt::format("uniform {} object_{};\n", type, name);
        declare_own(type, name);
    };
    if (has_color_textures(scene)) declare_own("vec3", "color");
    if (has_emission(scene)) {
        text += "// The emission of the object.\n";
        declare("vec3", "emission");
    }
    if (has_occlusion(scene)) {
        text += "// The fraction of ambient light that reaches it.\n";
        declare("float", "occlusion");
    }
    return text;
}

std::string material_units(const ExportedScene& scene) {
    const std::size_t count = most_material_pictures(scene);
    if (count == 0) return "";
    std::string declarations, choices;
    for (std::size_t i = 0; i < count; ++i) {
        declarations += fmt::format(
            "uniform highp usampler2D material_texels_{0};\nuniform ColorTexture material_texture_{0};\n", i);
        if (i > 0)
            choices +=
                fmt::format("    if (unit == {0}) return texelFetch(material_texels_{0}, at, 0);\n", i);
    }
    return fmt::format(
        "{}uvec4 texel_of_unit(int unit, ivec2 at) {{\n{}    return texelFetch(material_texels_0, at, "
        "0);\n}}\n",
        declarations, choices);
}

std::string texture_functions(const ExportedScene& scene, const std::string& units) {
    const bool in_shadows = has_shadow_pictures(scene);
    return filled(
               candela_target_texture,
               {{"UNITS", units},
                {"SHADOW_PICTURES", in_shadows ? "float shadow_picture_texel(int first, int number);\n" : ""},
                {"SHADOW_PICTURE",
                 in_shadows ? "    if (t.unit < 0) return vec3(shadow_picture_texel(-t.unit, y * t.width + "
                              "x));  // of an opacity, among the shadows\n"
                            : ""}}) +
           std::string(texture_kernel()) + "\n";
}

}  // namespace candela::target
