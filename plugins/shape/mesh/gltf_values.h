// Values of JSON that may be of any type, as files from anywhere have it.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace mesh::gltf {

using Json = nlohmann::json;

/// A JSON object that is not nested too deeply. Throws BadFile.
Json parsed(std::string_view text);

/// The array, or the object, of that name, or an empty one.
const Json& array_of(const Json& object, const char* name);
const Json& object_of(const Json& object, const char* name);
/// What an extension says of an object; null if it says nothing.
const Json* extension_of(const Json& object, const char* name);
/// The same, where an extension has had two names.
const Json* extension_of(const Json& object, const char* name, const char* other_name);
std::optional<std::size_t> index_of(const Json& object, const char* name);
/// Null if there is none.
const Json* element(const Json& array, std::optional<std::size_t> index);
/// Empty if there is none.
std::string text_of(const Json& object, const char* name);

}  // namespace mesh::gltf
