#include "shadows.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <utility>
#include <vector>

#include "candela/embed.h"
#include "candela/target/arrays.h"
#include "candela/target/literals.h"
#include "candela/target/shadow_tree.h"
#include "candela/target/textures.h"

CANDELA_EMBED(candela_opengl_shadows, CANDELA_SOURCE_DIR "/templates/shadows.cpp");
CANDELA_EMBED(candela_opengl_shadow_opacity, CANDELA_SOURCE_DIR "/templates/shadow_opacity.cpp");

namespace candela::opengl_target {

using namespace target;

namespace {

constexpr const char* k_shadow_members =
    "    bool receives_shadows;\n"
    "    bool is_solid;  // closed, with nothing inside: it blocks light only where the light enters it\n"
    "    vec3 middle;    // of the box around it\n";

constexpr const char* k_set_object =
    "            set(program, {\"object_index\", Uniform::whole, {static_cast<float>(i), 0, 0}});\n"
    "            set(program, {\"is_shadowed\", Uniform::whole, {object.receives_shadows && "
    "choice.has_shadows ? 1.0f : 0.0f, 0, 0}});\n"
    "            set(program, {\"blocks_both_sides\", Uniform::whole, "
    "{object.is_solid ? 0.0f : 1.0f, 0, 0}});\n"
    "            set(program, {\"object_middle\", Uniform::vector, object.middle});\n"
    "            set_sight(program, observer, view, width, height, sample);\n"
    "            set(program, {\"picture_height\", Uniform::whole, {static_cast<float>(height), 0, 0}});\n";

constexpr const char* k_key =
    "        case GLFW_KEY_H:\n"
    "            hand.choice.has_shadows = !hand.choice.has_shadows;\n"
    "            hand.is_dirty = true;\n"
    "            break;\n";

constexpr const char* k_help = "                 \"  --no-shadows            objects block no light\\n\"\n";

constexpr const char* k_argument =
    "        else if (words[i] == \"--no-shadows\") choice.has_shadows = false;\n";

constexpr const char* k_shadow_opacity =
    "        const float cutoff = k_objects[i].opacity_cutoff, uncut = k_objects[i].opacity;\n"
    "        const float opacity = cutoff <= 0 ? uncut : uncut >= cutoff ? 1.0f : 0.0f;\n";
constexpr const char* k_put_opacity =
    "            std::memcpy(&texels[at + 1][3], &opacity, sizeof(opacity));\n";

constexpr const char* k_add_opacity =
    "    for (const ShadowOpacity& one : k_shadow_opacities) add_opacity(tree, one, texels);\n"
    "    texels.resize((texels.size() + width - 1) / width * width);\n";

constexpr const char* k_picture_members =
    "    int texture;  // -1: the vertices give the opacity\n"
    "    std::size_t texel_channel;\n"
    "    int wrap_u, wrap_v;\n"
    "    std::array<float, 6> placing;  // of texture coordinates: a row for u and one for v\n";
constexpr const char* k_add_picture =
    "    if (of.texture >= 0) {\n"
    "        const TextureLevel picture = read_ppm(k_textures[static_cast<std::size_t>(of.texture)]);\n"
    "        texels[use + 1] = {picture.width, picture.height, static_cast<GLint>(use + 2), of.wrap_u + 3 * "
    "of.wrap_v};\n"
    "        const std::size_t count = picture.texels.size() / 4;\n"
    "        texels.resize(use + 2 + (count + 3) / 4);\n"
    "        for (std::size_t i = 0; i < count; ++i) texels[use + 2 + i / 4][i % 4] = picture.texels[4 * i + "
    "of.texel_channel];\n"
    "    }\n";
constexpr const char* k_place =
    "    if (of.texture >= 0) {\n"
    "        const auto row = [&](const float* r) { return r[0] * numbers[0] + r[1] * numbers[1] + r[2]; };\n"
    "        numbers = {row(&of.placing[0]), row(&of.placing[3])};\n"
    "    }\n";
constexpr const char* k_channels_member =
    "    int channel;  // the first of the vertices' channels that it depends on; -1: on texture "
    "coordinates\n";
constexpr const char* k_read_channels =
    "    const auto channel = [&](std::size_t c) { return c < mesh.channel_count ? mesh.channels[c][vertex] "
    ": "
    "0.0f; };\n"
    "    const auto first = static_cast<std::size_t>(of.channel);\n"
    "    if (of.channel >= 0) numbers = {channel(first), channel(first + 1)};\n";

/// The opacities that a texture or the vertices give, among the shadows.
std::string varying_opacities(const ExportedScene& scene) {
    if (!has_textured_shadows(scene)) return "";
    const bool has_pictures = has_shadow_pictures(scene), has_channels = has_opacity_of_channels(scene);
    std::string text;
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        const ExportedObject& object = scene.objects[i];
        if (!has_textured_shadow(scene, object)) continue;
        const ExportedTexturedNumber& number = object.opacity_numbers.front();
        std::vector<std::string> members{fmt::format("{}", i), float_text(number.scale),
                                         float_text(number.offset)};
        if (has_channels) {
            const auto channel = opacity_channel(object);
            members.push_back(channel ? fmt::format("{}", *channel) : "-1");
        }
        if (has_pictures && is_of_vertices(number)) {
            members.emplace_back("-1, 0, 0, 0, {}");
        } else if (has_pictures) {
            std::vector<std::string> placing;
            for (const float x : number.placing) placing.push_back(float_text(x));
            members.push_back(fmt::format("{}, {}, {}, {}, {{{}}}", number.texture, number.texel_channel,
                                          static_cast<int>(number.wrap[0]), static_cast<int>(number.wrap[1]),
                                          fmt::join(placing, ", ")));
        }
        text += fmt::format("    {{{}}},\n", fmt::join(members, ", "));
    }
    return filled(candela_opengl_shadow_opacity, {{"OPACITIES", text},
                                                  {"CHANNEL_MEMBER", has_channels ? k_channels_member : ""},
                                                  {"PICTURE_MEMBERS", has_pictures ? k_picture_members : ""},
                                                  {"READ_CHANNELS", has_channels ? k_read_channels : ""},
                                                  {"PLACE", has_pictures ? k_place : ""},
                                                  {"ADD_PICTURE", has_pictures ? k_add_picture : ""}});
}

constexpr const char* k_struct = R"(
// The tree of boxes around the triangles that block light, node by node, each before its children.
struct ShadowTree {
    std::size_t nodes, triangles;
    const int* links;   // two numbers a node: the node at which a ray goes on that misses its box, or that has met its
                        // triangles, or -1; and 8 times the first texel of its triangles plus their number, or -1
    const int* places;  // of each triangle of all objects in the tree, or -1
};
)";

std::string arrays_of(const ShadowTree& tree) {
    return k_struct +
           fmt::format("inline ShadowTree shadow_tree() {{\n{}{}    return {{{}, {}, links, places}};\n}}\n",
                       number_array("int", "links", tree.nodes), number_array("int", "places", tree.places),
                       tree.nodes.size() / 2, tree.triangle_count);
}

}  // namespace

Values shadow_values(const ExportedScene& scene) {
    const auto if_shadows = [&](const char* text) { return scene.has_shadows ? text : ""; };
    std::string texture, arrays, set_tree;
    if (scene.has_shadows) {
        const ShadowTree tree = shadow_tree(scene);
        const bool passes = lets_light_through(scene);
        texture =
            filled(candela_opengl_shadows, {{"WIDTH", fmt::format("{}", k_shadow_tree_width)},
                                            {"TEXTURED_OPACITY", varying_opacities(scene)},
                                            {"ADD_OPACITY", has_textured_shadows(scene) ? k_add_opacity : ""},
                                            {"SHADOW_OPACITY", passes ? k_shadow_opacity : ""},
                                            {"PUT_OPACITY", passes ? k_put_opacity : ""}});
        arrays = arrays_of(tree);
        set_tree = fmt::format(
            "        set(program, {{\"shadow_tree\", Uniform::whole, {{5, 0, 0}}}});\n"
            "        set(program, {{\"least_margin\", Uniform::real, {{{}, 0, 0}}}});\n",
            float_text(tree.least_margin));
    }
    return {
        {"SHADOW_KEYS", if_shadows("//                                            H: shadows on or off\n")},
        {"SHADOW_KEYS_SHORT", if_shadows(", H: shadows on or off")},
        {"SHADOW_HELP", if_shadows(k_help)},
        {"SHADOW_README", if_shadows(", turn shadows off and on with H")},
        {"SHADOW_ARGUMENT", if_shadows(k_argument)},
        {"SHADOW_MEMBERS", if_shadows(k_shadow_members)},
        {"SHADOW_CHOICE", if_shadows("    bool has_shadows = true;\n")},
        {"SHADOW_KEY", if_shadows(k_key)},
        {"SHADOWS", std::move(texture)},
        {"BIND_SHADOWS", if_shadows("        glActiveTexture(GL_TEXTURE5);\n        shadow_texture();\n")},
        {"SET_SHADOW_TREE", std::move(set_tree)},
        {"SET_SHADOWS", if_shadows(k_set_object)},
        {"SHADOW_ARRAYS", std::move(arrays)}};
}

std::string shadow_members(const ExportedScene& scene, const ExportedObject& object,
                           const ExportedMesh& mesh) {
    if (!scene.has_shadows) return "";
    const Vec3 middle = middle_of(mesh);
    return fmt::format(", {}, {}, {{{}, {}, {}}}", object.receives_shadows, mesh.is_solid,
                       float_text(middle.x), float_text(middle.y), float_text(middle.z));
}

}  // namespace candela::opengl_target
