// The allowed contents of a scene file's tables.
module;

#include "candela/plugin/export.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

export module candela.scene:schema;

import candela.api;
import candela.plugins;

export namespace candela {

/// A key whose value is the name of a plugin.
struct PluginKey {
    std::string key;  // "type"
    PluginKind kind = PluginKind::light;
    /// Where in the table the plugin's parameters are: next to the key (""), or in a nested table
    /// ("material"). Nothing: not in this table.
    std::optional<std::string> parameters_in{};
};

/// The allowed contents of one table of the scene file, apart from what plugins declare.
struct TableSchema {
    std::string name{};  // "image", "light"
    std::string title;   // as written in a file: "[image]", "[[light]]"
    std::string meaning;
    std::vector<Parameter> parameters{};
    bool repeated = false;              // may occur any number of times
    std::vector<PluginKey> plugins{};   // which of the parameters name plugins
    std::vector<std::string> lists{};   // which of the parameters are lists of such values
    std::vector<std::string> timed{};   // which of the parameters are lists of [time, value]
    std::vector<TableSchema> tables{};  // within this one
};

/// The tables of the scene file, in the order in which people write them.
CANDELA_EXPORT std::span<const TableSchema> scene_schema();

/// The table that a parameter of a reflection model may have instead of a value.
CANDELA_EXPORT const TableSchema& texture_schema();
/// The one that takes its value from the vertices.
CANDELA_EXPORT const TableSchema& vertex_attribute_schema();
/// Whether a parameter of a plugin may have them.
CANDELA_EXPORT bool takes_texture(const Manifest& plugin, const Parameter& parameter);

/// The keys of [object.material] that belong to every material, unless its model has a parameter of that
/// name.
CANDELA_EXPORT const TableSchema& material_schema();
/// That of them with that name, which must exist.
CANDELA_EXPORT const Parameter& material_parameter(std::string_view name);
/// Whether such a key may have a texture.
CANDELA_EXPORT bool takes_texture(const Parameter& of_material);
/// The key 'color' of [[object]], which may have one, too.
CANDELA_EXPORT const Parameter& color_parameter();

/// The keys before all tables; its name is empty.
CANDELA_EXPORT const TableSchema& top_schema();

}  // namespace candela
