module;

#include <fmt/format.h>

#include <cstddef>
#include <optional>
#include <string>

module candela.scene;

import :fields;
import :tables;
import :textures;
import :vocabulary;
import candela.plugins;
import candela.util;

namespace candela {

void read_transform(const TableNode& texture, const TableContext& of_texture, Diagnostics& diagnostics,
                    TextureTransform& to) {
    const TableNode::Entry* const entry = texture.find("transform");
    if (entry == nullptr) return;
    TableContext context = of_texture;
    context.where = "'transform' of " + of_texture.where;
    context.place = entry->node.place;
    const Table<TextureTransform>& keys = own_tables().texture_transform;
    const TableNode* const transform = entry->node.table();
    if (transform == nullptr) {
        diagnostics.error(entry->node.place,
                          fmt::format("{} is {}; expected a table, such as {{ scale = [2, 2] }}",
                                      context.where, description(entry->node)));
        return;
    }
    report_unknown_keys(*transform, names_in(*keys.schema()), context, diagnostics);
    keys.assign(transform, read_parameters(*transform, keys.schema(), context, diagnostics).set, to);
    for (const char* const key : {"scale", "offset"}) {
        const TableNode::Entry* const pair = transform->find(key);
        const ArrayNode* const numbers = pair != nullptr ? pair->node.array() : nullptr;
        if (numbers != nullptr && numbers->size() != 2)
            diagnostics.error(
                pair->node.place,
                fmt::format("'{}' has {} numbers; expected two, along u and v", key, numbers->size()));
    }
}

std::optional<NormalMap> normal_map_in(const TableNode& object, const std::string& where,
                                       Diagnostics& diagnostics) {
    const TableNode::Entry* const normals = object.find("normal_map");
    const TableNode::Entry* const heights = object.find("bump_map");
    if (normals != nullptr && heights != nullptr) {
        diagnostics.error(heights->key_place,
                          fmt::format("{} has a 'normal_map' and a 'bump_map'; expected one of them", where));
        return std::nullopt;
    }
    const bool has_heights = heights != nullptr;
    const TableNode::Entry* const entry = has_heights ? heights : normals;
    if (entry == nullptr) return std::nullopt;
    const Table<NormalMap>& keys = has_heights ? own_tables().bump_map : own_tables().normal_map;
    TableContext context{fmt::format("'{}' of {}", keys.about().name, where), {}, entry->node.place};
    context.lists_keys = true;
    const TableNode* const table = entry->node.table();
    if (table == nullptr) {
        diagnostics.error(
            entry->node.place,
            fmt::format("{} is {}; expected a table, such as {{ texture = \"{}.png\"{} }}", context.where,
                        description(entry->node), has_heights ? "heights" : "normals",
                        has_heights ? ", height = 0.01" : ""));
        return std::nullopt;
    }
    const std::size_t errors = diagnostics.error_count();
    NormalMap map{.has_heights = has_heights};
    report_unknown_keys(*table, names_in(*keys.schema(), {"transform"}), context, diagnostics);
    keys.assign(table, read_parameters(*table, keys.schema(), context, diagnostics).set, map);
    read_transform(*table, context, diagnostics, map.placing.transform);
    if (diagnostics.error_count() != errors) return std::nullopt;
    return map;
}

}  // namespace candela
