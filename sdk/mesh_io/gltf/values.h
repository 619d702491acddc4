// JSON values of any type, as untrusted files contain them.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mesh_io::gltf {

using Json = nlohmann::json;

/// Parses a JSON object that is not nested too deeply. Throws BadFile.
Json parsed(std::string_view text);

/// The member of that name; null if absent.
const Json* find(const Json& object, const char* name);
/// The array or object of that name, or an empty one.
const Json& array_of(const Json& object, const char* name);
const Json& object_of(const Json& object, const char* name);
/// An extension's member of an object; null if absent.
const Json* extension_of(const Json& object, const char* name);
/// Like extension_of(), for an extension that has had two names.
const Json* extension_of(const Json& object, const char* name, const char* other_name);
std::optional<std::size_t> index_of(const Json& object, const char* name);
/// Null if absent.
const Json* element(const Json& array, std::optional<std::size_t> index);
/// The number if it is finite; otherwise `otherwise`.
double number(const Json& object, const char* name, double otherwise);
/// An array of `count` finite numbers; otherwise empty.
std::vector<double> numbers(const Json& object, const char* name, std::size_t count);
/// Empty if absent.
std::string text_of(const Json& object, const char* name);

}  // namespace mesh_io::gltf
