module;

#include "candela/plugin/abi.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

module candela.plugins;

import candela.api;
import candela.util;

namespace candela {

std::string_view host_abi() noexcept { return CANDELA_ABI; }

Notation notation_of(const Manifest& manifest, const Parameter& parameter) {
    if (manifest.kind != PluginKind::light || parameter.name != "intensity" ||
        parameter.type != ParamType::real)
        return Notation::plain;
    const auto has = [&](std::string_view name, ParamType type) {
        return std::ranges::any_of(manifest.parameters,
                                   [&](const Parameter& p) { return p.name == name && p.type == type; });
    };
    // A photometric file has units of its own, which the intensity multiplies.
    if (std::ranges::any_of(manifest.parameters,
                            [](const Parameter& p) { return p.type == ParamType::file; }))
        return Notation::plain;
    if (has("position", ParamType::point))
        return has("inner_angle", ParamType::real) && has("outer_angle", ParamType::real)
                   ? Notation::cone
                   : Notation::intensity;
    return has("direction", ParamType::direction) ? Notation::illuminance : Notation::plain;
}

std::string Manifest::id() const { return fmt::format("{}/{}", candela::name_of(kind), name); }

std::optional<std::string> Manifest::property(std::string_view property_name) const {
    for (const auto& [key, value] : properties) {
        if (key == property_name) return value;
    }
    return std::nullopt;
}

void require_name(std::string_view text, std::string_view what) {
    constexpr std::size_t k_longest = 200;
    if (text.size() > k_longest)
        throw Error(
            ErrorCategory::bad_request,
            fmt::format("its {} has {} characters; at most {} are allowed", what, text.size(), k_longest));
    if (printable(text) != text)
        throw Error(ErrorCategory::bad_request,
                    fmt::format("its {} '{}' contains invisible characters", what, printable(text)));
}

Manifest manifest_of(const PluginDescriptor& d, std::string_view abi) {
    Manifest m;
    m.abi = abi;
    m.kind = d.kind;
    m.name = d.name;
    m.version = d.version;
    m.title = d.title;
    m.summary = d.summary;
    m.formula = d.formula;
    m.reference = d.reference;
    for (const ParamSpec& spec : d.parameters) m.parameters.push_back(parameter_of(spec));
    for (const RelationSpec& spec : d.relations) m.relations.push_back(relation_of(spec));
    for (const Property& p : d.properties) m.properties.emplace_back(p.name, p.value);
    for (const PresetSpec& p : d.presets) m.presets.push_back(preset_of(p, d.parameters));
    for (const FileFormat& f : d.formats)
        m.formats.push_back({f.extension, f.title, f.pixels, f.reads, f.layers});
    m.has_ambient = d.has_ambient;
    m.surface_needs = d.surface_needs;
    m.shading_needs = d.shading_needs;
    m.has_kernel = d.kernel.text != nullptr && d.kernel.prefix != nullptr;
    if (m.has_kernel) {
        m.kernel_prefix = d.kernel.prefix;
        m.kernel_parameters = d.kernel.parameters;
    }
    return m;
}

}  // namespace candela
