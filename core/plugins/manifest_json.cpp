// A manifest as JSON text.
module;

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

module candela.plugins;

import candela.api;
import candela.util;

namespace candela {

namespace {

using Json = nlohmann::ordered_json;

constexpr int k_manifest_version = 1;

Json json_of(const Value& value, ParamType type) {
    if (const auto* const string = std::get_if<std::string>(&value)) return *string;
    // A scene may have one number for three; a manifest does not.
    const std::string text = toml_text(value, type == ParamType::rgb ? ParamType::vector : type);
    // As a view, like manifests: a parser of strings' iterators would be compiled as well.
    return Json::parse(std::string_view(text));
}

Json json_of(const Parameter& p) {
    Json json;
    json["name"] = p.name;
    json["type"] = name_of(p.type);
    if (!p.unit.empty()) json["unit"] = p.unit;
    if (p.default_value) json["default"] = json_of(*p.default_value, p.type);
    if (p.minimum != k_no_minimum) json[p.minimum_excluded ? "above" : "minimum"] = shortest(p.minimum);
    if (p.maximum != k_no_maximum) json[p.maximum_excluded ? "below" : "maximum"] = shortest(p.maximum);
    if (!p.choices.empty()) json["choices"] = p.choices;
    json["meaning"] = p.meaning;
    return json;
}

Json json_of(const Preset& p, const std::vector<Parameter>& parameters) {
    Json json{{"name", p.name}, {"source", p.source}, {"values", Json::object()}};
    for (const auto& [name, value] : p.values) {
        const auto of = std::ranges::find(parameters, name, &Parameter::name);
        json["values"][name] = json_of(value, of != parameters.end() ? of->type : ParamType::real);
    }
    if (p.color) json["color"] = json_of(*p.color, ParamType::color);
    return json;
}

constexpr std::array<std::pair<const char*, bool SurfaceNeeds::*>, 4> k_surface_needs{
    {{"tangent", &SurfaceNeeds::tangent},
     {"uv", &SurfaceNeeds::uv},
     {"position", &SurfaceNeeds::position},
     {"varying", &SurfaceNeeds::varying}}};
constexpr std::array<std::pair<const char*, bool ShadingNeeds::*>, 7> k_shading_needs{
    {{"face_normal", &ShadingNeeds::face_normal},
     {"vertex_normal", &ShadingNeeds::vertex_normal},
     {"barycentric", &ShadingNeeds::barycentric},
     {"uv", &ShadingNeeds::uv},
     {"derivatives", &ShadingNeeds::derivatives},
     {"triangle", &ShadingNeeds::triangle},
     {"default_vertex_normals", &ShadingNeeds::default_vertex_normals}}};

/// The names of what is needed.
template <class Members, class Needs>
Json json_of(const Members& members, const Needs& needs) {
    Json names = Json::array();
    for (const auto& [name, member] : members) {
        if (needs.*member) names.push_back(name);
    }
    return names;
}

template <class Members, class Needs>
void read_needs(const Json& names, const Members& members, Needs& needs) {
    for (const auto& [known, member] : members) needs.*member = false;
    for (const Json& name : names) {
        for (const auto& [known, member] : members)
            needs.*member = needs.*member || name.get_ref<const std::string&>() == known;
    }
}

Json json_of(const Manifest& m) {
    Json json;
    json["candela_manifest"] = k_manifest_version;
    json["abi"] = m.abi;
    json["kind"] = name_of(m.kind);
    json["name"] = m.name;
    json["version"] = m.version;
    json["title"] = m.title;
    json["summary"] = m.summary;
    json["formula"] = m.formula;
    json["reference"] = m.reference;
    if (!m.author.empty()) json["author"] = m.author;
    if (!m.license.empty()) json["license"] = m.license;
    json["parameters"] = Json::array();
    for (const Parameter& p : m.parameters) json["parameters"].push_back(json_of(p));
    json["relations"] = Json::array();
    for (const Relation& r : m.relations) {
        json["relations"].push_back({{"type", name_of(r.type)},
                                     {"left", r.left},
                                     {"right", r.right},
                                     {"only_warns", r.only_warns},
                                     {"meaning", r.meaning}});
    }
    json["properties"] = Json::object();
    for (const auto& [name, value] : m.properties) json["properties"][name] = value;
    for (const Preset& p : m.presets) json["presets"].push_back(json_of(p, m.parameters));
    if (!m.formats.empty()) {
        json["formats"] = Json::array();
        for (const ManifestFormat& f : m.formats) {
            json["formats"].push_back({{"extension", f.extension},
                                       {"title", f.title},
                                       {"pixels", f.pixels == PixelType::byte ? "byte" : "real"},
                                       {"reads", f.reads},
                                       {"layers", f.layers}});
        }
    }
    if (m.has_ambient) json["has_ambient"] = true;
    if (m.surface_needs != SurfaceNeeds{}) json["needs"] = json_of(k_surface_needs, m.surface_needs);
    if (m.kind == PluginKind::shading) json["needs"] = json_of(k_shading_needs, m.shading_needs);
    if (m.has_kernel) json["kernel"] = {{"prefix", m.kernel_prefix}, {"parameters", m.kernel_parameters}};
    return json;
}

[[noreturn]] void refuse(const std::string& reason) { throw Error(ErrorCategory::failure, reason); }

template <class Named>
auto named(const Json& json, std::string_view what, Named named_function) {
    const auto name = json.get<std::string>();
    const auto found = named_function(name);
    if (!found) refuse(fmt::format("unknown {} '{}'", what, shortened(name)));
    return *found;
}

std::int64_t whole_number(const Json& json) {
    const bool is_large =
        json.is_number_unsigned() &&
        json.get<std::uint64_t>() > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
    if (!json.is_number_integer() || is_large) refuse(json.dump() + " is not an integer in range");
    return json.get<std::int64_t>();
}

float channel(const Json& json) {
    const std::int64_t number = whole_number(json);
    if (number < 0 || number > 256) refuse(json.dump() + "is not a colour channel: 0 to 255");
    return static_cast<float>(number);
}

Value value_from(const Json& json, ParamType type) {
    switch (type) {
        case ParamType::real:
            return json.get<double>();
        case ParamType::integer:
            return whole_number(json);
        case ParamType::boolean:
            return json.get<bool>();
        case ParamType::choice:
        case ParamType::text:
        case ParamType::file:
            return json.get<std::string>();
        case ParamType::matrix: {
            Matrix rows{};
            if (json.size() != 3) refuse("a matrix must have three rows");
            for (std::size_t i = 0; i < rows.size(); ++i) {
                if (json.at(i / 3).size() != 3) refuse("a row of a matrix must have three numbers");
                rows[i] = json.at(i / 3).at(i % 3).get<float>();
            }
            return rows;
        }
        case ParamType::numbers:
            if (!json.is_array() || json.empty()) refuse("the default must be a list of numbers");
            return json.get<std::vector<float>>();
        default:
            if (json.size() != 3) refuse("the default must have three numbers");
            if (type == ParamType::color)
                return Vec3{channel(json.at(0)), channel(json.at(1)), channel(json.at(2))};
            return Vec3{json.at(0).get<float>(), json.at(1).get<float>(), json.at(2).get<float>()};
    }
}

Parameter parameter_from(const Json& json) {
    Parameter p;
    p.name = json.at("name").get<std::string>();
    p.type = named(json.at("type"), "parameter type", param_type_named);
    p.unit = json.value("unit", "");
    if (json.contains("default")) p.default_value = value_from(json["default"], p.type);
    p.minimum_excluded = json.contains("above");
    p.maximum_excluded = json.contains("below");
    p.minimum = json.value(p.minimum_excluded ? "above" : "minimum", k_no_minimum);
    p.maximum = json.value(p.maximum_excluded ? "below" : "maximum", k_no_maximum);
    if (json.contains("choices")) p.choices = json["choices"].get<std::vector<std::string>>();
    p.meaning = json.at("meaning").get<std::string>();
    const auto wrong = [&](const std::string& what) {
        refuse(fmt::format("parameter '{}': {}", shortened(p.name), what));
    };
    if (p.type == ParamType::choice && p.choices.empty()) wrong("it has no choices");
    if (std::isnan(p.minimum) || std::isinf(p.minimum) != (p.minimum == k_no_minimum) ||
        std::isinf(p.maximum) != (p.maximum == k_no_maximum)) {
        wrong("its range is not a range of numbers");
    }
    if (p.default_value) {
        // Checking the default against its range is the conformance kit's task; here it only has to be
        // representable.
        Parameter unbounded = p;
        unbounded.minimum = k_no_minimum;
        unbounded.maximum = k_no_maximum;
        if (const auto problem = validation_error(unbounded, *p.default_value))
            wrong("its default: " + *problem);
    }
    return p;
}

Preset preset_from(const Json& json, const std::vector<Parameter>& parameters) {
    Preset p{.name = json.at("name").get<std::string>(),
             .source = json.at("source").get<std::string>(),
             .values = {},
             .color = {}};
    require_name(p.name, "preset's name");
    for (const auto& [name, value] : json.at("values").items()) {
        const auto of = std::ranges::find(parameters, name, &Parameter::name);
        if (of == parameters.end())
            refuse(fmt::format("preset '{}' sets '{}', but there is no such parameter", shortened(p.name),
                               shortened(name)));
        p.values.emplace_back(name, value_from(value, of->type));
    }
    if (json.contains("color")) p.color = std::get<Vec3>(value_from(json["color"], ParamType::color));
    return p;
}

Manifest manifest_from(const Json& json) {
    if (whole_number(json.at("candela_manifest")) != k_manifest_version) {
        refuse("its manifest version is not supported");
    }
    Manifest m;
    m.abi = json.at("abi").get<std::string>();
    m.kind = named(json.at("kind"), "plugin kind", plugin_kind_named);
    m.name = json.at("name").get<std::string>();
    m.version = json.at("version").get<std::string>();
    m.title = json.at("title").get<std::string>();
    m.summary = json.at("summary").get<std::string>();
    m.formula = json.at("formula").get<std::string>();
    m.reference = json.at("reference").get<std::string>();
    m.author = json.value("author", "");
    m.license = json.value("license", "");
    require_name(m.author, "author");
    require_name(m.license, "license");
    for (const Json& p : json.at("parameters")) m.parameters.push_back(parameter_from(p));
    for (std::size_t i = 0; i < m.parameters.size(); ++i) {
        const bool is_double =
            std::any_of(m.parameters.begin(), m.parameters.begin() + static_cast<std::ptrdiff_t>(i),
                        [&](const Parameter& p) { return p.name == m.parameters[i].name; });
        if (is_double) refuse(fmt::format("two parameters are called '{}'", shortened(m.parameters[i].name)));
    }
    for (const Json& r : json.at("relations")) {
        m.relations.push_back({named(r.at("type"), "relation type", relation_type_named),
                               r.at("left").get<std::string>(), r.at("right").get<std::string>(),
                               r.at("only_warns").get<bool>(), r.at("meaning").get<std::string>()});
    }
    for (const auto& [name, value] : json.at("properties").items()) {
        m.properties.emplace_back(name, value.get<std::string>());
    }
    if (json.contains("presets")) {
        for (const Json& p : json["presets"]) m.presets.push_back(preset_from(p, m.parameters));
    }
    if (json.contains("formats")) {
        for (const Json& f : json["formats"]) {
            const auto pixels =
                f.at("pixels").get<std::string>() == "byte" ? PixelType::byte : PixelType::real;
            m.formats.push_back({f.at("extension").get<std::string>(), f.at("title").get<std::string>(),
                                 pixels, f.at("reads").get<bool>(), f.at("layers").get<bool>()});
        }
    }
    m.has_ambient = json.contains("has_ambient") && json["has_ambient"].get<bool>();
    if (const auto needs = json.find("needs"); needs != json.end()) {
        if (m.kind == PluginKind::reflection) read_needs(*needs, k_surface_needs, m.surface_needs);
        if (m.kind == PluginKind::shading) read_needs(*needs, k_shading_needs, m.shading_needs);
    }
    m.has_kernel = json.contains("kernel");
    if (m.has_kernel) {
        m.kernel_prefix = json["kernel"].at("prefix").get<std::string>();
        m.kernel_parameters = json["kernel"].at("parameters").get<std::string>();
    }
    return m;
}

/// Puts each array of numbers on one line, as a person would write it.
std::string with_short_arrays(std::string_view json) {
    std::string result;
    bool is_in_text = false;
    for (std::size_t i = 0; i < json.size(); ++i) {
        const char c = json[i];
        result += c;
        if (is_in_text && c == '\\') {
            result += json[++i];  // an escaped character does not end the string
            continue;
        }
        if (c == '"') is_in_text = !is_in_text;
        if (c != '[' || is_in_text) continue;
        const std::size_t end = json.find_first_not_of("0123456789+-.eE, \n", i + 1);
        if (end == std::string_view::npos || json[end] != ']') continue;
        for (std::size_t k = i + 1; k < end; ++k) {
            if (json[k] == ' ' || json[k] == '\n') continue;
            result += json[k];
            if (json[k] == ',') result += ' ';
        }
        i = end - 1;
    }
    return result;
}

}  // namespace

std::string to_json(const Manifest& manifest) { return with_short_arrays(json_of(manifest).dump(2)) + "\n"; }

std::string to_json(std::span<const Manifest> manifests) {
    Json all = Json::array();
    for (const Manifest& manifest : manifests) all.push_back(json_of(manifest));
    return with_short_arrays(all.dump(2)) + "\n";
}

Manifest manifest_from_json(std::string_view text) {
    try {
        return manifest_from(Json::parse(text));
    } catch (const Json::exception& problem) {
        throw Error(ErrorCategory::failure, fmt::format("it is not a manifest: {}", problem.what()));
    }
}

std::string abi_from_json(std::string_view text) {
    const Json json = Json::parse(text, nullptr, false);
    const bool says_so = json.is_object() && json.contains("abi") && json["abi"].is_string();
    return says_so ? json["abi"].get<std::string>() : "";
}

}  // namespace candela
