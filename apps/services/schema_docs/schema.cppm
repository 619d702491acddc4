// Describes the scene file for programs and for people: the scene's own keys and those of the installed
// plugins, from the declarations that the reader itself uses.
module;

#include <optional>
#include <span>
#include <string>
#include <vector>

export module candela.schema;

import candela.plugins;

export namespace candela {

/// A JSON Schema (draft-07) of the scene file, for editors and other validators: every key with its type,
/// range, default and meaning. A file may be a part of a scene, so neither `version` nor [observer] is
/// required. read_scene() checks what JSON Schema cannot express (relations, unique names, whether a file
/// exists, 1.0 in place of an integer). Ends with a newline. Any thread.
std::string scene_json_schema(std::span<const Manifest> installed);

/// The same contents for people, with formulas, papers and picture formats: a page in Markdown. Any thread.
std::string scene_reference(std::span<const Manifest> installed);

}  // namespace candela

// Shared by both.
namespace candela {

/// The default as written in a scene, with three equal numbers as one; nothing if there is no default.
std::optional<std::string> default_text(const Parameter& parameter);

/// A JSON Schema, as text, for the parameter's type and range.
std::string value_schema(const Parameter& parameter);

/// Manifests whose parameters say how they may be written.
std::vector<Manifest> with_notations(std::span<const Manifest> manifests);

/// "metres" for "m", "degrees" for "deg"; other units unchanged.
std::string unit_word(const Parameter& parameter);

}  // namespace candela
