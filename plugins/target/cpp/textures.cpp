#include "textures.h"

#include <fmt/format.h>

#include <cstddef>

#include "candela/embed.h"
#include "candela/target/text_template.h"
#include "candela/target/textures.h"

CANDELA_EMBED(candela_cpp_textures, CANDELA_SOURCE_DIR "/templates/textures.h");
CANDELA_EMBED(candela_cpp_texture_seen, CANDELA_SOURCE_DIR "/templates/texture_seen.h");
CANDELA_EMBED(candela_cpp_channels, CANDELA_SOURCE_DIR "/templates/channels.h");
CANDELA_EMBED(candela_cpp_placed_texture, CANDELA_SOURCE_DIR "/templates/placed_texture.h");
CANDELA_EMBED(candela_cpp_normal_maps, CANDELA_SOURCE_DIR "/templates/normal_maps.h");
CANDELA_EMBED(candela_cpp_normal_texel, CANDELA_SOURCE_DIR "/templates/normal_texel.h");
CANDELA_EMBED(candela_cpp_textured_material, CANDELA_SOURCE_DIR "/templates/textured_material.h");

namespace candela::cpp_target {

using namespace target;

namespace {

constexpr const char* k_placing =
    "// How a texture is placed: u' = m[0] u + m[1] v + m[2], v' with the other three.\n"
    "using Placing = std::array<float, 6>;\n\n";
constexpr const char* k_number_of =
    "float number_of(float texel, float scale, float offset, float low, float high) { return "
    "std::min(std::max(offset + scale * texel, low), high); }\n\n";

constexpr const char* k_on_mesh_members =
    "    const Mesh* mesh = nullptr;\n"
    "    int triangle = -1;       // on which it is, with the weights of its corners; -1: it is a vertex\n"
    "    std::size_t vertex = 0;  // if it is one\n"
    "    vec3 weights;\n";
constexpr const char* k_on_mesh_within =
    "    at.mesh = &m;\n    at.triangle = triangle;\n    at.weights = b;\n";
constexpr const char* k_on_mesh_at_vertex = "    at.mesh = &o.mesh;\n    at.vertex = v;\n";
constexpr const char* k_on_second_uv_member =
    "    bool is_on_second_uv = false;  // by which texture coordinates it is placed\n";
constexpr const char* k_normal_place =
    "o.normal_map.is_on_second_uv ? on_second_uv(place_within(o, triangle, b)) : place_within(o, triangle, "
    "b)";

}  // namespace

const char* mesh_channels_of(const ExportedScene& scene) {
    return needs_channels(scene)
               ? "    std::vector<std::vector<float>> channels;  // numbers of the vertices\n"
               : "";
}

TextureTexts textures_of(const ExportedScene& scene, const std::string& textured_materials) {
    const bool has_pictures = !scene.textures.empty(), has_channels = needs_channels(scene);
    if (!has_pictures && !has_channels) return {};
    std::string images;
    for (std::size_t i = 0; i < scene.textures.size(); ++i) {
        images += fmt::format(
            "const std::vector<TextureLevel>& texture_{}() {{  // {}\n"
            "    static const std::vector<TextureLevel> levels = texture_levels(\"{}\");\n"
            "    return levels;\n}}\n\n",
            i, title_of(scene.textures[i]), texture_file(i));
    }
    const bool has_materials = !textured_materials.empty(), has_normals = has_normal_maps(scene),
               has_opacities = has_textured_opacity(scene);
    const auto if_channels = [&](const char* text) { return std::string(has_channels ? text : ""); };
    const auto if_pictures = [&](const std::string& text) { return has_pictures ? text : std::string(); };
    TextureTexts texts;
    texts.declarations =
        if_pictures(filled(candela_cpp_textures, {{"FILE", std::string(texture_file_source())},
                                                  {"KERNEL", std::string(texture_kernel())},
                                                  {"PICTURES", images}}) +
                    k_placing);
    if (has_normals)
        texts.declarations +=
            filled(candela_cpp_normal_maps, {{"KERNEL", std::string(normal_map_kernel())},
                                             {"ON_SECOND_UV_MEMBER", if_channels(k_on_second_uv_member)}});
    texts.seen = filled(candela_cpp_texture_seen,
                        {{"IS_SEEN_PARAMETER", has_opacities ? ", bool is_seen = false" : ""},
                         {"IS_SEEN", has_opacities ? "is_seen || " : ""},
                         {"ON_MESH_MEMBERS", if_channels(k_on_mesh_members)},
                         {"ON_MESH_WITHIN", if_channels(k_on_mesh_within)},
                         {"ON_MESH_AT_VERTEX", if_channels(k_on_mesh_at_vertex)},
                         {"CHANNELS", if_channels(candela_cpp_channels)},
                         {"TEXTURE_AT", if_pictures(candela_cpp_placed_texture)}});
    if (has_materials || has_opacities) texts.seen += k_number_of;
    if (has_normals) {
        const char* const place = has_channels ? k_normal_place : "place_within(o, triangle, b)";
        texts.seen += filled(candela_cpp_normal_texel, {{"PLACE", place}});
    }
    if (has_materials) texts.seen += filled(candela_cpp_textured_material, {{"CASES", textured_materials}});
    return texts;
}

const char* readme_of_textures() {
    return "The pictures of textures are PPM files next to `scene.cpp`, which many programs show and edit: "
           "with 8 bits per channel for colours, with 16\nfor intensities. They must stay in the folder of "
           "`scene.cpp` or of the program.\n\n";
}

}  // namespace candela::cpp_target
