// What a scene file may hold, for programs and for people: the scene's own keys and those of the plugins that
// are installed, from the declarations that the reader itself works with.
module;

#include <optional>
#include <span>
#include <string>

export module candela.schema;

import candela.parameters;
import candela.registry;

export namespace candela {

/// A JSON Schema (draft-07) of the scene file, for editors and other validators: every key with its type,
/// range, default and meaning. A file may be a part of a scene, so that neither `version` nor [observer] is
/// required. What no JSON Schema can say (relations, names that must differ, whether a file exists, 1.0 where
/// an integer is due) is left to read_scene(). Ends with a newline. Any thread.
std::string scene_json_schema(std::span<const Manifest> installed);

/// The same for people, with formulas, papers and picture formats: a page in Markdown. Any thread.
std::string scene_reference(std::span<const Manifest> installed);

}  // namespace candela

// What both are made with.
namespace candela {

/// The default as one would write it in a scene, a triple of equal numbers as one; nothing where there is
/// none.
std::optional<std::string> default_text(const Parameter& parameter);

/// What a value of the parameter's type and range must be: a JSON Schema, as text.
std::string value_schema(const Parameter& parameter);

/// "metres" for "m", "degrees" for "deg"; other units are what they are.
std::string unit_word(const Parameter& parameter);

}  // namespace candela
