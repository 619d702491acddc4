#include "import/gltf_json.h"

#include <cmath>

namespace importing::gltf {

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

std::string text(const Json& object, const char* name) {
    const Json* const found = find(object, name);
    return found != nullptr && found->is_string() ? found->get<std::string>() : "";
}

}  // namespace importing::gltf
