#include "mesh_io/gltf/values.h"

#include <fmt/format.h>

#include "mesh_io/surface.h"

namespace mesh_io::gltf {

namespace {

/// Parsers may recurse; no glTF file is nested more deeply.
void require_shallow(std::string_view json) {
    constexpr int k_deepest = 64;
    int depth = 0;
    bool in_string = false;
    for (std::size_t i = 0; i < json.size(); ++i) {
        const char c = json[i];
        if (in_string) {
            if (c == '\\') ++i;
            if (c == '"') in_string = false;
        } else if (c == '"') {
            in_string = true;
        } else if (c == '{' || c == '[') {
            if (++depth > k_deepest)
                throw BadFile(fmt::format("has JSON nested more than {} deep", k_deepest));
        } else if (c == '}' || c == ']') {
            --depth;
        }
    }
}

}  // namespace

Json parsed(std::string_view text) {
    require_shallow(text);
    try {
        Json json = Json::parse(text);
        if (!json.is_object()) throw BadFile("is not a glTF file: its JSON is not an object");
        return json;
    } catch (const Json::parse_error& problem) {
        throw BadFile(fmt::format("is not valid JSON from byte {} on", problem.byte));
    }
}

const Json& array_of(const Json& object, const char* name) {
    static const Json k_empty = Json::array();
    if (!object.is_object()) return k_empty;
    const auto found = object.find(name);
    return found != object.end() && found->is_array() ? *found : k_empty;
}

const Json& object_of(const Json& object, const char* name) {
    static const Json k_empty = Json::object();
    if (!object.is_object()) return k_empty;
    const auto found = object.find(name);
    return found != object.end() && found->is_object() ? *found : k_empty;
}

const Json* extension_of(const Json& object, const char* name) {
    const Json& extensions = object_of(object, "extensions");
    const auto found = extensions.find(name);
    return found != extensions.end() && found->is_object() ? &*found : nullptr;
}

const Json* extension_of(const Json& object, const char* name, const char* other_name) {
    const Json* const found = extension_of(object, name);
    return found != nullptr ? found : extension_of(object, other_name);
}

std::optional<std::size_t> index_of(const Json& object, const char* name) {
    if (!object.is_object()) return std::nullopt;
    const auto found = object.find(name);
    if (found == object.end() || !found->is_number_unsigned()) return std::nullopt;
    return found->get<std::size_t>();
}

const Json* element(const Json& array, std::optional<std::size_t> index) {
    return index && *index < array.size() ? &array[*index] : nullptr;
}

std::string text_of(const Json& object, const char* name) {
    if (!object.is_object()) return "";
    const auto found = object.find(name);
    return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

}  // namespace mesh_io::gltf
