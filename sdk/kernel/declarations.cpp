#include "candela/kernel_language/declarations.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <sstream>
#include <stdexcept>
#include <variant>

import candela.scene;
import candela.util;

namespace candela::kernel_language {

namespace {

std::vector<std::string> words_of(const std::string& text) {
    std::istringstream stream(text);
    std::vector<std::string> words;
    for (std::string word; stream >> word;) words.push_back(word);
    return words;
}

std::optional<double> number_in(const std::string& text) {
    std::istringstream stream(text);
    double number = 0;
    if (!(stream >> number) || stream.peek() != std::istringstream::traits_type::eof()) return std::nullopt;
    return number;
}

std::optional<double> number_of(const Value& value) {
    if (const auto* const real = std::get_if<double>(&value)) return *real;
    if (const auto* const integer = std::get_if<std::int64_t>(&value)) return static_cast<double>(*integer);
    return std::nullopt;
}

bool is_equal(const Value& value, const std::string& text) {
    if (const auto* const word = std::get_if<std::string>(&value)) return *word == text;
    if (const auto number = number_of(value)) return number_in(text) == number;
    return text_of(value) == text;
}

bool holds(const Condition& condition, const ParamSet& values) {
    const std::size_t index = values.index_of(condition.parameter);
    if (index == values.schema().size() || !values.get(index)) return false;
    const Value& value = *values.get(index);
    if (condition.kind == Condition::Kind::is_one_of) {
        return std::ranges::any_of(condition.values,
                                   [&](const std::string& text) { return is_equal(value, text); });
    }
    const auto actual = number_of(value), bound = number_in(condition.values.front());
    if (!actual || !bound) return false;
    return condition.kind == Condition::Kind::is_at_least ? *actual >= *bound : *actual <= *bound;
}

bool has_parameter(const SharedSchema& parameters, std::string_view name) {
    return std::ranges::any_of(*parameters, [&](const Parameter& each) { return each.name == name; });
}

enum class Takes { nothing, a_condition, attenuation, an_integer, a_box, names };

struct KnownProperty {
    PluginKind kind;
    const char* name;
    Takes takes;
};

constexpr auto k_known_properties = std::to_array<KnownProperty>({
    {PluginKind::reflection, "reciprocal", Takes::a_condition},
    {PluginKind::reflection, "energy-bounded", Takes::a_condition},
    {PluginKind::reflection, "isotropic", Takes::a_condition},
    {PluginKind::reflection, "lights-below-horizon", Takes::nothing},
    {PluginKind::reflection, "may-be-negative", Takes::nothing},
    {PluginKind::reflection, "fixed-in-world", Takes::nothing},
    {PluginKind::light, "attenuation", Takes::attenuation},
    {PluginKind::shading, "fixed-in-world", Takes::nothing},
    {PluginKind::shape, "closed", Takes::nothing},
    {PluginKind::shape, "open", Takes::nothing},
    {PluginKind::shape, "parametric", Takes::nothing},
    {PluginKind::shape, "euler-characteristic", Takes::an_integer},
    {PluginKind::shape, "bounding-box", Takes::a_box},
    {PluginKind::image, "fallback", Takes::nothing},
    {PluginKind::target, "exact-light", Takes::names},
    {PluginKind::target, "exact-reflection", Takes::names},
    {PluginKind::target, "exact-shading", Takes::names},
});

/// The problem with a property's value; empty if there is none.
std::string wrong_with(Takes takes, const std::string& value, const SharedSchema& parameters) {
    std::array<float, 6> box{};
    int end = -1;
    switch (takes) {
        case Takes::nothing:
            return value == "true" ? "" : fmt::format("'{}'; its only value is \"true\"", value);
        case Takes::attenuation:
            return value == "constant" || value == "by distance"
                       ? ""
                       : fmt::format(R"('{}'; it is "constant" or "by distance")", value);
        case Takes::an_integer: {
            int number = 0;
            const bool is_one = std::sscanf(value.c_str(), "%d%n", &number, &end) == 1 &&
                                static_cast<std::size_t>(end) == value.size();
            return is_one ? "" : fmt::format("'{}'; its value is an integer", value);
        }
        case Takes::a_box:
            return std::sscanf(value.c_str(), "%f %f %f %f %f %f", &box[0], &box[1], &box[2], &box[3],
                               &box[4], &box[5]) == 6
                       ? ""
                       : fmt::format("'{}'; its value is six numbers, low x y z, high x y z", value);
        case Takes::names: {
            const std::vector<std::string> names = property_names(value);
            const bool are_names = !names.empty() && std::ranges::all_of(names, candela::is_plugin_name);
            return are_names ? "" : fmt::format(R"('{}'; it takes names: "lambert, phong")", value);
        }
        case Takes::a_condition:
            break;
    }
    try {
        for (const Condition& condition : conditions_of(value)) {
            if (!has_parameter(parameters, condition.parameter))
                return fmt::format("'{}'; it has no parameter '{}'", value, condition.parameter);
        }
    } catch (const std::invalid_argument& problem) {
        return problem.what();
    }
    return {};
}

/// Why a name is not a property of that kind.
std::string unknown_property(PluginKind kind, const std::string& name) {
    std::vector<std::string> known;
    for (const KnownProperty& p : k_known_properties) {
        if (p.kind == kind) known.emplace_back(p.name);
    }
    for (const KnownProperty& p : k_known_properties) {
        if (p.name == name)
            return fmt::format("'{}' is a property of a {} plugin, not of a {} plugin", name, name_of(p.kind),
                               name_of(kind));
    }
    const std::string meant = suggestion(name, known);
    return fmt::format("unknown property '{}'{}{} ({})", name, meant.empty() ? "" : "; ", meant,
                       known.empty() ? fmt::format("a {} plugin has no properties", name_of(kind))
                                     : fmt::format("known: {}", fmt::join(known, ", ")));
}

}  // namespace

std::vector<Condition> conditions_of(const std::string& property_value) {
    if (property_value == "true") return {};
    const auto malformed = [&] {
        return std::invalid_argument(fmt::format(
            R"('{}'; it is "true", or such as "where form is disc or ring and shininess is at least 1")",
            property_value));
    };
    const std::vector<std::string> words = words_of(property_value);
    std::size_t at = 0;
    const auto next = [&] {
        if (at == words.size()) throw malformed();
        return words[at++];
    };
    const auto skip = [&](const char* word) {
        if (at == words.size() || words[at] != word) return false;
        ++at;
        return true;
    };
    if (!skip("where")) throw malformed();
    std::vector<Condition> conditions;
    do {
        Condition& condition = conditions.emplace_back();
        condition.parameter = next();
        if (next() != "is") throw malformed();
        if (skip("at")) {
            const std::string bound = next();
            if (bound != "least" && bound != "most") throw malformed();
            condition.kind = bound == "least" ? Condition::Kind::is_at_least : Condition::Kind::is_at_most;
            condition.values.push_back(next());
            if (!number_in(condition.values.front())) throw malformed();
            continue;
        }
        do {
            condition.values.push_back(next());
        } while (skip("or"));
    } while (skip("and"));
    if (at != words.size()) throw malformed();
    return conditions;
}

bool hold(const std::vector<Condition>& conditions, const ParamSet& values) {
    return std::ranges::all_of(conditions, [&](const Condition& c) { return holds(c, values); });
}

std::vector<std::string> property_names(const std::string& property_value) {
    std::vector<std::string> names;
    for (std::size_t begin = 0; begin <= property_value.size();) {
        const std::size_t comma = std::min(property_value.find(", ", begin), property_value.size());
        names.push_back(property_value.substr(begin, comma - begin));
        begin = comma + 2;
    }
    return names;
}

std::optional<std::string> property_problem(PluginKind kind, const std::string& name,
                                            const std::string& value, const SharedSchema& parameters) {
    const auto* const known = std::ranges::find_if(
        k_known_properties, [&](const KnownProperty& p) { return p.kind == kind && p.name == name; });
    if (known == k_known_properties.end()) return unknown_property(kind, name);
    const std::string wrong = wrong_with(known->takes, value, parameters);
    if (wrong.empty()) return std::nullopt;
    return fmt::format("the property '{}' is {}", name, wrong);
}

std::optional<std::string> parameter_name_problem(PluginKind kind, std::string_view name) {
    for (const TableSchema& table : scene_schema()) {
        const bool holds_them = std::ranges::any_of(
            table.plugins, [&](const PluginKey& key) { return key.kind == kind && key.parameters_in == ""; });
        const bool has_key =
            std::ranges::any_of(table.parameters, [&](const Parameter& key) { return key.name == name; }) ||
            std::ranges::any_of(table.plugins,
                                [&](const PluginKey& key) { return key.parameters_in == name; });
        if (holds_them && has_key && !name.empty())
            return fmt::format(
                "'{}' is a key of {} itself, so that a scene cannot set a parameter of that name; choose "
                "another",
                name, table.title);
    }
    return std::nullopt;
}

std::optional<std::string> relation_problem(const Relation& relation, const SharedSchema& parameters) {
    for (const std::string& name : {relation.left, relation.right}) {
        if (has_parameter(parameters, name)) continue;
        std::vector<std::string> names;
        for (const Parameter& each : *parameters) names.push_back(each.name);
        const std::string meant = suggestion(name, names);
        return fmt::format("the relation \"{}\" is about '{}', but there is no such parameter{}{}",
                           text_of(relation), name, meant.empty() ? "" : "; ", meant);
    }
    return std::nullopt;
}

std::vector<std::string> preset_problems(const Preset& preset, PluginKind kind,
                                         const SharedSchema& parameters,
                                         const std::vector<Relation>& relations) {
    std::vector<std::string> problems;
    const auto wrong = [&](const std::string& what) {
        problems.push_back(fmt::format("preset '{}' {}", preset.name, what));
    };
    if (preset.name.empty()) wrong("has no name");
    if (preset.values.empty()) wrong("has no values");
    if (preset.color && kind != PluginKind::reflection) wrong("has a colour, but is not a material");
    ParamSet set(parameters);
    for (const auto& [name, value] : preset.values) {
        const std::size_t index = set.index_of(name);
        if (index == parameters->size()) {
            wrong(fmt::format("sets '{}', but there is no such parameter", name));
        } else if (const auto problem = validation_error((*parameters)[index], value)) {
            wrong(fmt::format("has {} for '{}': {}", text_of(value), name, *problem));
        } else {
            set.set(index, value);
        }
    }
    for (const Relation& relation : relations) {
        if (relation.only_warns) continue;
        if (const auto problem = validation_error(relation, set)) wrong("is refused: " + *problem);
    }
    return problems;
}

}  // namespace candela::kernel_language
