#include "textures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "candela/embed.h"
#include "candela/target/glsl.h"
#include "candela/target/textures.h"
#include "literals.h"

CANDELA_EMBED(candela_opengl_textures, CANDELA_SOURCE_DIR "/templates/textures.cpp");

namespace candela::opengl_target {

using namespace target;

namespace {

constexpr const char* k_put_corners =
    "            for (std::size_t corner = 0; corner < 3; ++corner) put(9 + corner, vector(mesh.position, "
    "v[corner]));\n";

constexpr const char* k_put_edges =
    "            for (std::size_t i = 0; i < 4; ++i) {  // how u and v change along two of the edges\n"
    "                const auto uv = [&](std::size_t vertex) { return mesh.uv == nullptr ? 0.0f : mesh.uv[2 "
    "* vertex + i % 2]; };\n"
    "                all[15].push_back(uv(v[1 + i / 2]) - uv(v[0]));\n"
    "            }\n";

constexpr const char* k_edge_channel =
    "            const std::size_t first = rate == Rate::fragment ? 0 : mesh.opacity_channel;\n";
constexpr const char* k_put_channels =
    "            for (std::size_t c = 0; c < 8 && mesh.channel_count > 0; ++c) {{  // numbers of the "
    "vertices\n"
    "                const auto channel = [&](std::size_t number, std::size_t vertex) {{\n"
    "                    return number < mesh.channel_count ? mesh.channels[number][vertex] : 0.0f;\n"
    "                }};\n"
    "                all[13 + c / 4].push_back(rate == Rate::face ? (channel(c, v[0]) + channel(c, v[1]) + "
    "channel(c, v[2])) / 3 : channel(c, v[k]));\n"
    "                if (c < 4) all[12].push_back(channel({0}c % 2, v[1 + c / 2]) - channel({0}c % 2, "
    "v[0]));\n"
    "            }}\n";

constexpr const char* k_load =
    "        glActiveTexture(GL_TEXTURE6);\n"
    "        for (const char* const file : k_textures) textures_.push_back(make_texture(file));\n";

constexpr const char* k_members =
    "    int material;                                        // in k_materials; -1: no textures\n"
    "    int common_material;                                 // with another reflection model\n"
    "    int normal_map;                                      // in k_normal_maps; -1: none\n"
    "    int opacity_map;                                     // in k_opacities; -1: none\n";
constexpr const char* k_picture =
    "// A picture that an object reads, and its continuation along u and v: as color_texture_wrapped() "
    "says.\n"
    "struct Picture {\n    std::size_t texture;\n    int wrap_u, wrap_v;\n};\n";
constexpr const char* k_pictures_member =
    "    std::vector<Picture> pictures;                       // that these read\n";

constexpr const char* k_bind =
    "            set_pixel(program, observer, view, height);\n"
    "            const bool reads_pictures = (reflection == object.reflection ? object.material : "
    "object.common_material) >= 0 || object.normal_map >= 0 || object.opacity_map >= 0;\n"
    "            // Even a sampler that is not read must refer to a texture of its type.\n"
    "            for (std::size_t k = 0; k < {} && reads_pictures; ++k) {{\n"
    "                const Picture picture = k < object.pictures.size() ? object.pictures[k] : Picture{{0, "
    "0, 0}};\n"
    "                bind(textures_[picture.texture], picture, program, k);\n"
    "            }}\n";

std::string declarations_of(const ExportedScene& scene) {
    std::string files;
    for (std::size_t i = 0; i < scene.textures.size(); ++i)
        files += fmt::format("    \"{}\",  // {}\n", texture_file(i), title_of(scene.textures[i]));
    return filled(candela_opengl_textures, {{"FILE", std::string(texture_file_source())}, {"FILES", files}});
}

std::string put_channels(const ExportedScene& scene) {
    const bool has_edge_channel = has_opacity_of_channels(scene);
    return (has_edge_channel ? k_edge_channel : "") +
           fmt::format(fmt::runtime(k_put_channels), has_edge_channel ? "first + " : "");
}

/// The texts that objects' programs have after their models.
std::string texts_of(const char* name, std::initializer_list<const std::vector<std::string>*> lists) {
    std::string all = fmt::format("const std::vector<std::string> {} = {{\n", name);
    for (const auto* const texts : lists) {
        for (const std::string& text : *texts)
            if (!text.empty()) all += fmt::format("    {},\n", raw(text));
    }
    return all + "};\n";
}

}  // namespace

Values texture_values(const ExportedScene& scene, const GlslParts& glsl) {
    const bool has_textures = has_textured_materials(scene), has_pictures = !scene.textures.empty();
    const auto if_pictures = [&](std::string text) { return has_pictures ? std::move(text) : std::string(); };
    const auto if_textures = [&](std::string text) { return has_textures ? std::move(text) : std::string(); };
    const std::string corners = sees_triangles(scene) ? "" : k_put_corners;
    return {
        {"TEXTURE_SHADER", if_textures(fmt::format("const std::string k_texture = {};\n", raw(glsl.texture)) +
                                       texts_of("k_materials", {&glsl.materials, &glsl.common_materials}) +
                                       texts_of("k_normal_maps", {&glsl.normal_maps}) +
                                       texts_of("k_opacities", {&glsl.opacities}))},
        {"PICTURE", if_pictures(k_picture)},
        {"TEXTURE_MEMBERS", if_textures(k_members) + if_pictures(k_pictures_member)},
        {"TEXTURES", has_pictures ? declarations_of(scene) : ""},
        {"PUT_TEXTURE", if_pictures(corners + k_put_edges)},
        {"SKIP_ABSENT", if_textures("        if (all[i].empty()) continue;\n")},
        {"FIND_TEXTURES", if_pictures("        look_for_textures_at(argv[0]);\n")},
        {"LOAD_TEXTURES", if_pictures(k_load)},
        {"PUT_CHANNELS", needs_channels(scene) ? put_channels(scene) : ""},
        {"BIND_TEXTURE", scene.textures.empty() ? "" : fmt::format(k_bind, most_material_pictures(scene))},
        {"MATERIAL_OF",
         if_textures("        const int material = reflection == object.reflection ? object.material : "
                     "object.common_material;\n")},
        {"IS_TEXTURED", if_textures(", material, object.normal_map, object.opacity_map")},
        {"TEXTURE_TEXT",
         if_textures(
             " (material < 0 && object.normal_map < 0 && object.opacity_map < 0 ? \"\" : k_texture) +\n"
             "                                   (material < 0 ? \"\" : \"#define "
             "TEXTURED_MATERIAL\\n\") +")},
        {"MATERIAL_TEXT",
         if_textures(" + (material < 0 ? \"\" : k_materials[static_cast<std::size_t>(material)]) +\n"
                     "                                   (object.normal_map < 0 ? \"\" : "
                     "k_normal_maps[static_cast<std::size_t>(object.normal_map)]) +\n"
                     "                                   (object.opacity_map < 0 ? \"\" : "
                     "k_opacities[static_cast<std::size_t>(object.opacity_map)])")},
        {"TEXTURED_KEY", if_textures(", int, int, int")},
        {"TEXTURES_HELD", if_pictures("    std::vector<Texture> textures_;\n")}};
}

std::string texture_members(const ExportedScene& scene, std::size_t index) {
    if (!has_textured_materials(scene)) return "";
    const ExportedObject& object = scene.objects[index];
    const auto is_textured = [](const ExportedObject& o) { return !all_textured_numbers(o).empty(); };
    const auto is_mapped = [](const ExportedObject& o) { return o.normal_map != nullptr; };
    const auto is_covering = [](const ExportedObject& o) { return !o.opacity_numbers.empty(); };
    const auto number = [&](const auto& is_one) {
        return is_one(object) ? std::ranges::count_if(scene.objects.first(index), is_one) : -1;
    };
    std::string pictures;
    for (const MaterialPicture& picture : material_pictures(object))
        pictures += fmt::format("{}{{{}, {}, {}}}", pictures.empty() ? "" : ", ", picture.texture,
                                static_cast<int>(picture.wrap_u), static_cast<int>(picture.wrap_v));
    const auto own_texts = std::ranges::count_if(scene.objects, is_textured);
    return fmt::format(", {}, {}, {}, {}{}", number(is_textured),
                       has_common_textures(object) ? own_texts + number(has_common_textures) : -1,
                       number(is_mapped), number(is_covering),
                       scene.textures.empty() ? "" : fmt::format(", {{{}}}", pictures));
}

}  // namespace candela::opengl_target
