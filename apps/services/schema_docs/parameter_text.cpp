module;

#include <fmt/format.h>

#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

module candela.schema;

import candela.api;
import candela.plugins;

namespace candela {

std::optional<std::string> default_text(const Parameter& p) {
    if (!p.default_value) return std::nullopt;
    if (const auto* text = std::get_if<std::string>(&*p.default_value); text != nullptr && text->empty())
        return std::nullopt;
    if (const auto* v = std::get_if<Vec3>(&*p.default_value);
        p.type == ParamType::rgb && v->x == v->y && v->y == v->z) {
        return fmt::format("{}", v->x);
    }
    return text_of(*p.default_value);
}

std::vector<Manifest> with_notations(std::span<const Manifest> manifests) {
    std::vector<Manifest> noted(manifests.begin(), manifests.end());
    for (Manifest& manifest : noted)
        for (Parameter& parameter : manifest.parameters)
            parameter.notation = notation_of(manifest, parameter);
    return noted;
}

std::string unit_word(const Parameter& p) {
    if (p.unit == "m") return "metres";
    if (p.unit == "deg") return "degrees";
    return p.unit;
}

}  // namespace candela
