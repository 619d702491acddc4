// Reads JSON whose values may be of any type, as in untrusted files.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace importing::gltf {

using Json = nlohmann::json;

/// The member of that name, or null.
const Json* find(const Json& object, const char* name);
/// The array or object of that name, or an empty one.
const Json& array_of(const Json& object, const char* name);
const Json& object_of(const Json& object, const char* name);
std::optional<std::size_t> index_of(const Json& object, const char* name);
/// Null if there is none.
const Json* element(const Json& array, std::optional<std::size_t> index);
/// The number if it is finite; otherwise `otherwise`.
double number(const Json& object, const char* name, double otherwise);
/// An array of `count` finite numbers; otherwise empty.
std::vector<double> numbers(const Json& object, const char* name, std::size_t count);
std::string text(const Json& object, const char* name);

}  // namespace importing::gltf
