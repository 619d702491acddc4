// Validates a table against a schema: types, ranges, unknown and missing keys.
module;

#include "candela/plugin/export.h"

#include <functional>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

export module candela.scene:validation;

import :toml;
import candela.plugins;
import candela.util;

export namespace candela {

/// A table's place in the scene, for messages.
struct TableContext {
    std::string where;     // "[image]", "[[light]] 'lamp'"
    Help help;             // where its keys are explained
    SourceLocation place;  // of the table itself, for missing keys
    std::string note{};    // appended to the message on every unknown key; may be empty
    /// The name of an unknown key here, or the table where it belongs; null, or empty if that is unknown.
    std::function<std::string(const std::string& key)> hint{};
    bool lists_keys = false;  // whether the message on an unknown key lists the known ones
};

/// The values read from a table, and whether each is valid.
struct CANDELA_EXPORT TableValues {
    ParamSet set;                  // without a value, or with its default, where one is missing or invalid
    std::vector<bool> validity{};  // of the set's parameters: given a valid value, or left at the default
    bool breaks_relation = false;  // one that does not merely warn

    bool is_valid(std::string_view name) const;  // true if there is no such parameter
    bool are_valid(std::initializer_list<std::string_view> names) const;
    bool are_valid() const;  // all of them
};

/// The values of the keys in `schema`, with its defaults for missing ones. Reports wrong types, values out of
/// range, missing required keys, and violated relations between valid values, at the position of one of the
/// two. Keys that are not in the schema are ignored. Paths become absolute, relative to the file that
/// contains them.
CANDELA_EXPORT TableValues read_parameters(const TableNode& table, SharedSchema schema,
                                           const TableContext& context, Diagnostics& diagnostics,
                                           std::span<const Relation> relations = {});
/// Like the above, for a table of the plugin's parameters alone: reports unknown keys.
CANDELA_EXPORT TableValues read_parameters(const TableNode& table, const PluginFile& plugin,
                                           const TableContext& context, Diagnostics& diagnostics);

/// Reports every key that is not among `known`, with a suggestion.
CANDELA_EXPORT void report_unknown_keys(const TableNode& table, std::span<const std::string> known,
                                        const TableContext& context, Diagnostics& diagnostics);

/// `node` as a valid value of the parameter; the path of a file becomes absolute. Reports what is wrong.
CANDELA_EXPORT std::optional<Value> valid_value(const Node& node, const Parameter& parameter,
                                                Diagnostics& diagnostics);

}  // namespace candela
