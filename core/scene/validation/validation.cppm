// Validates a table of a document against a schema: types, ranges, unknown and missing keys.
module;

#include "candela/api.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

export module candela.validation;

import candela.diagnostics;
import candela.parameters;
import candela.toml;

export namespace candela {

/// Where in the scene a table stands, for messages.
struct TableContext {
    std::string where;   // "[image]", "[[light]] 'lamp'"
    Help help;           // where its keys are explained
    SourcePlace place;   // of the table itself, for what is missing in it
    std::string note{};  // said with every unknown key; may be empty
};

/// The values of the keys that `schema` has; its defaults for those that are missing. Reports wrong types,
/// values outside their range and missing required keys; those keep their default, or no value. Keys that the
/// schema does not have are not looked at. Paths become absolute: relative to the file that holds them.
CANDELA_API ParamSet read_parameters(const TableNode& table, SharedSchema schema, const TableContext& context,
                                     Diagnostics& diagnostics);
/// Likewise, by a schema that is not shared.
CANDELA_API ParamSet read_parameters(const TableNode& table, std::vector<Parameter> schema,
                                     const TableContext& context, Diagnostics& diagnostics);

/// Reports every key that is not among `known`, with a suggestion.
CANDELA_API void report_unknown_keys(const TableNode& table, std::span<const std::string> known,
                                     const TableContext& context, Diagnostics& diagnostics);

/// Reports what does not hold between two parameters, at the place of one of them.
CANDELA_API void check_relations(const TableNode& table, const ParamSet& values,
                                 std::span<const Relation> relations, const TableContext& context,
                                 Diagnostics& diagnostics);

/// `node` as a value of the parameter's type, without a look at its range. Reports a type mismatch.
CANDELA_API std::optional<Value> typed_value(const Node& node, const Parameter& parameter,
                                             Diagnostics& diagnostics);

}  // namespace candela
