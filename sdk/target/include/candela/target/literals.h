// Values and names as written in generated text.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "candela/color.h"
#include "candela/math.h"
#include "candela/plugin/params.h"

namespace candela::target {

/// "0.5f": valid in C++ and the kernel language, and exact.
std::string float_text(float x);
/// "vec3(1.0f, 0.0f, 0.5f)".
std::string vec3_text(Vec3 v);
/// A matrix's runtime values, column by column.
std::array<Vec3, 3> columns_of(const ParamValue& runtime);
/// A value as the initialiser of a kernel's member: "0.5f", "2", "vec3(...)", "mat3(...)"; a table as
/// "Table{12, 30}", its offset in ExportedScene::tables and its size. The word of a choice is added as a
/// comment.
std::string member_text(const ParamSpec& parameter, const ParamValue& runtime);

/// A float in the fewest digits that identify it: 0.1, not 0.10000000149011612.
double shortest(float x);

/// A plugin's name, of lower-case letters, digits and hyphens, as an identifier of C++ and GLSL:
/// "half-lambert" with the suffix "material" is "half_lambert_material". With a suffix it is never a keyword
/// of either language, and names with different suffixes do not clash.
std::string identifier(std::string_view name, std::string_view suffix);

/// A user's name as one line that is safe in a comment of C++, CMake or Markdown: letters, digits and a few
/// marks; '_' replaces everything else. Latin letters become ASCII ("Größe" is "Groesse"), and quotes around
/// a label are removed.
std::string ascii_identifier(std::string_view name);
/// Escapes text for an HTML page. Bytes that are not UTF-8 are replaced.
std::string html_text(std::string_view text);
/// Escapes JSON for a <script> of an HTML page, where "</script>" and "<!--" would end or change it.
std::string script_json(std::string json);

}  // namespace candela::target
