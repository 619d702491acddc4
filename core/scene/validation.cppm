// Validates a table against a schema: types, ranges, unknown and missing keys.
module;

#include "candela/plugin/export.h"

#include <functional>
#include <optional>
#include <span>
#include <string>
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

/// The values of the keys in `schema`, with its defaults for missing ones. Reports wrong types, values out of
/// range and missing required keys; those keep their default, or no value. Keys that are not in the schema
/// are ignored. Paths become absolute, relative to the file that contains them.
CANDELA_EXPORT ParamSet read_parameters(const TableNode& table, SharedSchema schema,
                                        const TableContext& context, Diagnostics& diagnostics);
/// Like the above, for a schema that is not shared.
CANDELA_EXPORT ParamSet read_parameters(const TableNode& table, std::vector<Parameter> schema,
                                        const TableContext& context, Diagnostics& diagnostics);

/// Whether `table` gives the parameter a valid value, or leaves it at its default.
CANDELA_EXPORT bool is_valid(const TableNode& table, const Parameter& parameter);

/// Reports every key that is not among `known`, with a suggestion.
CANDELA_EXPORT void report_unknown_keys(const TableNode& table, std::span<const std::string> known,
                                        const TableContext& context, Diagnostics& diagnostics);

/// Reports violated relations, at the position of one of the two parameters.
CANDELA_EXPORT void check_relations(const TableNode& table, const ParamSet& values,
                                    std::span<const Relation> relations, const TableContext& context,
                                    Diagnostics& diagnostics);

/// `node` as a valid value of the parameter; the path of a file becomes absolute. Reports what is wrong.
CANDELA_EXPORT std::optional<Value> valid_value(const Node& node, const Parameter& parameter,
                                                Diagnostics& diagnostics);

/// `node` as a value of the parameter's type, without checking its range. Reports a type mismatch.
CANDELA_EXPORT std::optional<Value> typed_value(const Node& node, const Parameter& parameter,
                                                Diagnostics& diagnostics);

}  // namespace candela
