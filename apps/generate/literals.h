// Values and names as they stand in generated text.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>
#include <variant>

import candela.core;

namespace generate {

/// "0.5f": C++ and the kernel language, to the last bit.
std::string float_text(float x);
/// "vec3(1.0f, 0.0f, 0.5f)".
std::string vec3_text(candela::Vec3 v);
/// A value as a kernel's member takes it: "0.5f", "2", "vec3(...)". A choice also says its word in a comment.
std::string member_text(const candela::Parameter& parameter, const candela::ParamValue& delivered);

/// A name that somebody chose, as one line that can stand in a comment of C++, CMake or Markdown: letters,
/// digits and a few marks; '_' for all else.
std::string tame(std::string_view name);
/// As text of an HTML page.
std::string html_text(std::string_view text);
/// JSON for a <script> of an HTML page, where "</script>" and "<!--" would end or change it. Bytes that are
/// not UTF-8 are replaced.
std::string script_json(const nlohmann::json& value);
/// A value as a person writes it in a scene file.
nlohmann::json json_value(const candela::Value& value);

std::string base64(std::span<const std::byte> bytes);
/// The bytes that a text of base64 stands for. Throws candela::Error where it is none.
std::string base64_decoded(std::string_view text);

}  // namespace generate
