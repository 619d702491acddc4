#include "mesh_io/gltf/losses.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <string_view>

#include "mesh_io/gltf/json.h"
#include "mesh_io/text_scanner.h"

namespace mesh_io::gltf {

namespace {

/// Extensions that do not affect triangles.
bool is_about_appearance(std::string_view extension) {
    constexpr std::array<std::string_view, 9> k_prefixes = {
        "KHR_materials_", "KHR_texture_", "EXT_texture_", "MSFT_texture_", "GOOGLE_texture_",
        "KHR_technique",  "KHR_lights_",  "EXT_lights_",  "KHR_xmp"};
    return std::ranges::any_of(k_prefixes, [&](std::string_view p) { return extension.starts_with(p); });
}

/// Supported extensions that affect triangles.
bool is_read(std::string_view extension) {
    constexpr std::array<std::string_view, 6> k_names = {
        "KHR_mesh_quantization",   "KHR_draco_mesh_compression", "EXT_meshopt_compression",
        "KHR_meshopt_compression", "EXT_mesh_gpu_instancing",    "KHR_node_visibility"};
    return std::ranges::find(k_names, extension) != k_names.end();
}

void note(std::vector<Unsupported>& losses, std::size_t count, std::string_view singular,
          bool is_appearance = false) {
    if (count > 0) losses.emplace_back(counted(count, singular), is_appearance);
}

}  // namespace

void require_known_extensions(const Json& json) {
    for (const Json& extension : array_of(json, "extensionsRequired")) {
        if (!extension.is_string()) continue;
        const auto& name = extension.get_ref<const std::string&>();
        if (is_about_appearance(name) || is_read(name) || name.starts_with("KHR_animation")) continue;
        throw BadFile(
            fmt::format("needs the glTF extension {}, which Candela does not read", in_quotes(name)));
    }
}

std::vector<Unsupported> losses_of(const Json& json, Attributes attributes) {
    std::vector<Unsupported> losses;
    for (const char* const what : {"material", "texture", "image", "camera", "animation"})
        note(losses, array_of(json, (std::string(what) + "s").c_str()).size(), what, true);
    if (const Json* const lights = extension_of(json, "KHR_lights_punctual"))
        note(losses, array_of(*lights, "lights").size(), "light", true);
    const bool reads_attributes = attributes == Attributes::read;
    std::size_t points = 0, lines = 0;
    bool has_more_colors = false, has_second_uv = false, has_other_attributes = false;
    for (const Json& mesh : array_of(json, "meshes")) {
        for (const Json& primitive : array_of(mesh, "primitives")) {
            const std::size_t mode = index_of(primitive, "mode").value_or(4);
            if (mode == 0) ++points;
            if (mode >= 1 && mode <= 3) ++lines;
            for (const auto& [name, unused] : object_of(primitive, "attributes").items()) {
                if (name.starts_with("COLOR_")) {
                    has_more_colors = has_more_colors || name != "COLOR_0";
                } else if (name.starts_with("TEXCOORD_")) {
                    has_second_uv =
                        has_second_uv || !(name == "TEXCOORD_0" || (reads_attributes && name == k_second_uv));
                } else if (reads_attributes && name.starts_with('_')) {
                    continue;
                } else if (name != "POSITION" && name != "NORMAL" && name != "TANGENT" &&
                           !name.starts_with("JOINTS_") && !name.starts_with("WEIGHTS_")) {
                    has_other_attributes = true;
                }
            }
        }
    }
    const auto note_sets = [&](std::size_t count, std::string_view of) {
        if (count > 0) losses.emplace_back(fmt::format("{} set{} of {}", count, count == 1 ? "" : "s", of));
    };
    note_sets(points, "points");
    note_sets(lines, "lines");
    if (has_more_colors) losses.emplace_back("further vertex colours");
    if (has_second_uv) losses.emplace_back("further texture coordinates", true);
    if (has_other_attributes) losses.emplace_back("custom vertex attributes");
    const std::size_t scenes = array_of(json, "scenes").size();
    if (scenes > 1) note(losses, scenes - 1, "other scene");
    std::set<std::string> extensions;
    for (const Json& extension : array_of(json, "extensionsUsed"))
        if (extension.is_string()) extensions.insert(extension.get<std::string>());
    std::vector<std::string> unknown;
    for (const std::string& name : extensions)
        if (!is_about_appearance(name) && !is_read(name)) unknown.push_back(in_quotes(name));
    constexpr std::size_t k_most_named = 5;
    if (unknown.size() > k_most_named) {
        const std::size_t more = unknown.size() - k_most_named;
        unknown.resize(k_most_named);
        unknown.push_back(fmt::format("{} more", more));
    }
    if (!unknown.empty())
        losses.emplace_back(
            fmt::format("the extension{} {}", unknown.size() == 1 ? "" : "s", listed(unknown)));
    return losses;
}

}  // namespace mesh_io::gltf
