#include "textures.h"

#include <fmt/format.h>

#include <cstddef>
#include <string>
#include <utility>

#include "candela/embed.h"
#include "candela/target/glsl.h"
#include "candela/target/textures.h"
#include "literals.h"

CANDELA_EMBED(candela_opengl_textures, CANDELA_SOURCE_DIR "/templates/textures.cpp");

namespace candela::opengl_target {

using namespace target;

namespace {

constexpr const char* k_members =
    "    int texture;           // -1: none\n"
    "    bool texture_repeats;  // beyond its edges; otherwise the edge colours continue\n";

constexpr const char* k_put_corners =
    "            for (std::size_t corner = 0; corner < 3; ++corner) put(9 + corner, vector(mesh.position, "
    "v[corner]));\n";

constexpr const char* k_put_edges =
    "            for (std::size_t i = 0; i < 4; ++i) {  // how u and v change along two of the edges\n"
    "                const auto uv = [&](std::size_t vertex) { return mesh.uv == nullptr ? 0.0f : mesh.uv[2 "
    "* vertex + i % 2]; };\n"
    "                all[15].push_back(uv(v[1 + i / 2]) - uv(v[0]));\n"
    "            }\n";

constexpr const char* k_load =
    "        glActiveTexture(GL_TEXTURE4);\n"
    "        for (const char* const file : k_textures) textures_.push_back(make_texture(file));\n";

constexpr const char* k_bind =
    "            if (object.texture >= 0)\n"
    "                bind(textures_[static_cast<std::size_t>(object.texture)], object.texture_repeats, "
    "program, observer, view, height);\n";

std::string declarations_of(const ExportedScene& scene) {
    std::string files;
    for (std::size_t i = 0; i < scene.textures.size(); ++i)
        files += fmt::format("    \"{}\",  // {}\n", texture_file(i), title_of(scene.textures[i]));
    return filled(candela_opengl_textures, {{"FILE", std::string(texture_file_source())}, {"FILES", files}});
}

}  // namespace

Values texture_values(const ExportedScene& scene, const std::string& shader) {
    const bool has_textures = !scene.textures.empty();
    const auto if_textures = [&](std::string text) { return has_textures ? std::move(text) : std::string(); };
    const std::string corners = sees_triangles(scene) ? "" : k_put_corners;
    return {{"TEXTURE_SHADER", if_textures(fmt::format("const std::string k_texture = {};\n", raw(shader)))},
            {"TEXTURE_MEMBERS", if_textures(k_members)},
            {"TEXTURES", has_textures ? declarations_of(scene) : ""},
            {"PUT_TEXTURE", if_textures(corners + k_put_edges)},
            {"SKIP_ABSENT", if_textures("        if (all[i].empty()) continue;\n")},
            {"FIND_TEXTURES", if_textures("        look_for_textures_at(argv[0]);\n")},
            {"LOAD_TEXTURES", if_textures(k_load)},
            {"BIND_TEXTURE", if_textures(k_bind)},
            {"IS_TEXTURED", if_textures(", object.texture >= 0")},
            {"TEXTURE_TEXT", if_textures(" (object.texture < 0 ? \"\" : k_texture) +")},
            {"TEXTURED_KEY", if_textures(", bool")},
            {"TEXTURES_HELD", if_textures("    std::vector<Texture> textures_;\n")}};
}

std::string texture_members(const ExportedScene& scene, const ExportedObject& object) {
    if (scene.textures.empty()) return "";
    if (object.color_texture == ExportedObject::k_no_texture) return ", -1, true";
    return fmt::format(", {}, {}", object.color_texture, object.color_texture_repeats);
}

}  // namespace candela::opengl_target
