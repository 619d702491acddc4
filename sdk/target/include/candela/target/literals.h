// Values and names as they stand in generated text.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "candela/color.h"
#include "candela/math.h"
#include "candela/params.h"

namespace candela::target {

/// "0.5f": C++ and the kernel language, to the last bit.
std::string float_text(float x);
/// "vec3(1.0f, 0.0f, 0.5f)".
std::string vec3_text(Vec3 v);
/// A matrix's values, as they are delivered, column by column.
std::array<Vec3, 3> columns_of(const ParamValue& delivered);
/// A value as a kernel's member takes it: "0.5f", "2", "vec3(...)", "mat3(...)"; a table as "Table{12, 30}",
/// where it begins in ExportedScene::tables and its size. A choice also says its word in a comment.
std::string member_text(const ParamSpec& parameter, const ParamValue& delivered);

/// A float in as few digits as name it exactly: 0.1, not 0.10000000149011612.
double shortest(float x);

/// A plugin's name, of lower-case letters, digits and hyphens, as an identifier of C++ and GLSL:
/// "half-lambert" with the suffix "material" is "half_lambert_material". With a suffix it is no keyword of
/// either language, and names with different suffixes do not clash.
std::string identifier(std::string_view name, std::string_view suffix);

/// A name that somebody chose, as one line that can stand in a comment of C++, CMake or Markdown: letters,
/// digits and a few marks; '_' for all else. Latin, Greek and Cyrillic letters become ASCII ("Größe" is
/// "Groesse"), and quotes around a label go.
std::string tame(std::string_view name);
/// As text of an HTML page. Bytes that are not UTF-8 are replaced.
std::string html_text(std::string_view text);
/// A JSON text for a <script> of an HTML page, where "</script>" and "<!--" would end or change it.
std::string script_json(std::string json);

std::string base64(std::span<const std::byte> bytes);
/// The same at the end of a text.
void append_base64(std::span<const std::byte> bytes, std::string& text);
/// The bytes that a text of base64 stands for. Throws std::invalid_argument where it is none.
std::string base64_decoded(std::string_view text);

}  // namespace candela::target
