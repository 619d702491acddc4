// Parts of a page's scene, as the scripts in this folder read them.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include "candela/target.h"
#include "candela/target/glsl.h"
#include "candela/target/page_arrays.h"
#include "candela/target/shadow_tree.h"
#include "candela/target/textures.h"

namespace candela::target {

/// The pictures that an object's material, normal map or opacity reads, each with how it continues beyond its
/// edges.
inline nlohmann::json pictures_json(const ExportedObject& object) {
    nlohmann::json pictures = nlohmann::json::array();
    for (const MaterialPicture& picture : material_pictures(object))
        pictures.push_back(
            {picture.texture, static_cast<int>(picture.wrap_u), static_cast<int>(picture.wrap_v)});
    return pictures;
}

/// The tree of the triangles that block light; the page takes their vertices from the meshes.
inline nlohmann::json shadows_json(const ExportedScene& scene, PageArrays& arrays) {
    const ShadowTree tree = shadow_tree(scene);
    const auto put = [&](const std::vector<std::int32_t>& numbers) {
        return arrays.put(std::as_bytes(std::span(numbers)));
    };
    return {{"nodes", put(tree.nodes)},
            {"places", put(tree.places)},
            {"triangles", tree.triangle_count},
            {"width", k_shadow_tree_width},
            {"least_margin", tree.least_margin}};
}

/// Adds an object's opacity to its JSON. `index`: of the object, and of its text in GlslParts::opacities.
inline void put_opacity(nlohmann::json& json, const ExportedScene& scene, std::size_t index) {
    const ExportedObject& object = scene.objects[index];
    const auto channel = opacity_channel(object);
    json["opacity_map"] = object.opacity_numbers.empty() ? nlohmann::json() : nlohmann::json(index);
    json["opacity_channel"] = channel ? nlohmann::json(*channel) : nlohmann::json();
    if (has_opacity(scene)) {
        json["opacity"] = object.opacity;
        json["opacity_cutoff"] = object.opacity_cutoff;
    }
    if (!has_textured_shadow(scene, object)) return;
    const ExportedTexturedNumber& number = object.opacity_numbers.front();
    json["shadow_opacity"] = {{"scale", number.scale}, {"offset", number.offset}};
    if (is_of_vertices(number)) return;
    json["shadow_opacity"]["picture"] = {
        {"texture", number.texture},
        {"channel", number.texel_channel},
        {"wraps", {static_cast<int>(number.wrap[0]), static_cast<int>(number.wrap[1])}},
        {"placing", number.placing}};
}

}  // namespace candela::target
