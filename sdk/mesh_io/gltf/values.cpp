#include "mesh_io/gltf/values.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mesh_io/bad_file.h"

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
    // Chunks padded with zeros instead of blanks.
    while (text.ends_with('\0')) text.remove_suffix(1);
    require_shallow(text);
    try {
        Json json = Json::parse(text);
        if (!json.is_object()) throw BadFile("is not a glTF file: its JSON is not an object");
        return json;
    } catch (const Json::parse_error& problem) {
        throw BadFile(fmt::format("is not valid JSON from byte {} on", problem.byte));
    } catch (const Json::out_of_range& problem) {
        // The library quotes the number at the end of its message.
        constexpr std::size_t k_longest = 60;
        const std::string_view message = problem.what();
        throw BadFile(fmt::format("has a number beyond the range of doubles: {}",
                                  message.substr(std::min(message.find('\''), message.size()), k_longest)));
    }
}

const Json* find(const Json& object, const char* name) {
    if (!object.is_object()) return nullptr;
    const auto found = object.find(name);
    return found != object.end() ? &*found : nullptr;
}

const Json& array_of(const Json& object, const char* name) {
    static const Json k_empty = Json::array();
    const Json* const found = find(object, name);
    return found != nullptr && found->is_array() ? *found : k_empty;
}

const Json& object_of(const Json& object, const char* name) {
    static const Json k_empty = Json::object();
    const Json* const found = find(object, name);
    return found != nullptr && found->is_object() ? *found : k_empty;
}

const Json* extension_of(const Json& object, const char* name) {
    const Json* const found = find(object_of(object, "extensions"), name);
    return found != nullptr && found->is_object() ? found : nullptr;
}

const Json* extension_of(const Json& object, const char* name, const char* other_name) {
    const Json* const found = extension_of(object, name);
    return found != nullptr ? found : extension_of(object, other_name);
}

std::optional<std::size_t> index_of(const Json& object, const char* name) {
    const Json* const found = find(object, name);
    if (found == nullptr || !found->is_number_unsigned()) return std::nullopt;
    return found->get<std::size_t>();
}

const Json* element(const Json& array, std::optional<std::size_t> index) {
    return index && *index < array.size() ? &array[*index] : nullptr;
}

double number(const Json& object, const char* name, double otherwise) {
    const Json* const found = find(object, name);
    if (found == nullptr || !found->is_number()) return otherwise;
    const auto value = found->get<double>();
    return std::isfinite(value) ? value : otherwise;
}

std::vector<double> numbers(const Json& object, const char* name, std::size_t count) {
    const Json& array = array_of(object, name);
    if (array.size() != count) return {};
    std::vector<double> result;
    for (const Json& each : array) {
        const double value = each.is_number() ? each.get<double>() : NAN;
        if (!std::isfinite(value)) return {};
        result.push_back(value);
    }
    return result;
}

std::string text_of(const Json& object, const char* name) {
    const Json* const found = find(object, name);
    return found != nullptr && found->is_string() ? found->get<std::string>() : "";
}

}  // namespace mesh_io::gltf
