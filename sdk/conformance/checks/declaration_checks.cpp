// Requirements for a plugin's description of itself: everything that it declares exists.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <catch2/catch_test_macros.hpp>
#include <cstdio>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "conditions.h"
#include "subject.h"

import candela.util;

using candela::Manifest;
using candela::PluginKind;

namespace {

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
std::string wrong_with(Takes takes, const std::string& value) {
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
            const std::vector<std::string> names = names_in(value);
            const bool are_names = !names.empty() && std::ranges::all_of(names, candela::is_plugin_name);
            return are_names ? "" : fmt::format(R"('{}'; it takes names: "lambert, phong")", value);
        }
        case Takes::a_condition:
            break;
    }
    try {
        for (const Condition& condition : conditions_of(value)) {
            const candela::ParamSet defaults(subject_manifest().parameters);
            if (defaults.index_of(condition.parameter) == defaults.schema().size())
                return fmt::format("'{}'; it has no parameter '{}'", value, condition.parameter);
        }
    } catch (const std::invalid_argument& problem) {
        return problem.what();
    }
    return {};
}

/// Why a name is not a property of this plugin's kind.
std::string unknown_property(const std::string& name) {
    const PluginKind kind = subject_manifest().kind;
    std::vector<std::string> known;
    for (const KnownProperty& p : k_known_properties) {
        if (p.kind == kind) known.emplace_back(p.name);
    }
    for (const KnownProperty& p : k_known_properties) {
        if (p.name == name)
            return fmt::format("it declares '{}', which is a property of a {} plugin, not of a {} plugin",
                               name, candela::name_of(p.kind), candela::name_of(kind));
    }
    const std::string meant = candela::suggestion(name, known);
    return fmt::format("unknown property '{}'{}{} ({})", name, meant.empty() ? "" : "; ", meant,
                       known.empty() ? fmt::format("a {} plugin has no properties", candela::name_of(kind))
                                     : fmt::format("known: {}", fmt::join(known, ", ")));
}

/// The problems with the presets: a scene with their values must be valid.
std::vector<std::string> wrong_presets(const Manifest& m) {
    std::vector<std::string> problems;
    const auto schema = std::make_shared<const std::vector<candela::Parameter>>(m.parameters);
    std::set<std::string> names;
    for (const candela::Preset& preset : m.presets) {
        const auto wrong = [&](const std::string& what) {
            problems.push_back(fmt::format("its preset '{}' {}", preset.name, what));
        };
        if (preset.name.empty() || !names.insert(preset.name).second)
            wrong("has no name, or the name of another");
        if (preset.values.empty()) wrong("has no values");
        if (preset.color && m.kind != PluginKind::reflection) wrong("has a colour, but is not a material");
        candela::ParamSet set(schema);
        for (const auto& [name, value] : preset.values) {
            const auto& parameter = m.parameters[set.index_of(name)];
            if (const auto problem = candela::validation_error(parameter, value)) {
                wrong(fmt::format("has {} for '{}': {}", candela::text_of(value), name, *problem));
            } else {
                set.set(set.index_of(name), value);
            }
        }
        for (const candela::Relation& relation : m.relations) {
            if (relation.only_warns) continue;
            if (const auto problem = candela::validation_error(relation, set))
                wrong("is refused: " + *problem);
        }
    }
    return problems;
}

}  // namespace

TEST_CASE("declarations: its properties are those of its kind, its relations are between its parameters",
          "[all]") {
    const Manifest& m = subject_manifest();
    std::set<std::string> declared_names;
    for (const auto& [name, value] : m.properties) {
        if (!declared_names.insert(name).second) FAIL_CHECK("it declares '" << name << "' twice");
        const auto* const known = std::ranges::find_if(
            k_known_properties, [&](const KnownProperty& p) { return p.kind == m.kind && p.name == name; });
        if (known == k_known_properties.end()) {
            FAIL_CHECK(unknown_property(name));
        } else if (const std::string wrong = wrong_with(known->takes, value); !wrong.empty()) {
            FAIL_CHECK("it declares '" << name << "' as " << wrong);
        }
    }
    std::vector<std::string> parameters;
    for (const candela::Parameter& p : m.parameters) {
        if (std::ranges::find(parameters, p.name) != parameters.end())
            FAIL_CHECK("it has two parameters called '" << p.name << "'");
        parameters.push_back(p.name);
    }
    for (const candela::Relation& relation : m.relations) {
        for (const std::string& name : {relation.left, relation.right}) {
            if (std::ranges::find(parameters, name) != parameters.end()) continue;
            const std::string meant = candela::suggestion(name, parameters);
            FAIL_CHECK("its relation \"" << candela::text_of(relation) << "\" is about '" << name
                                         << "', but it has no such parameter" << (meant.empty() ? "" : "; ")
                                         << meant);
        }
    }
    for (const std::string& problem : wrong_presets(m)) FAIL_CHECK(problem);
    if (!m.formats.empty() && m.kind != PluginKind::image)
        FAIL_CHECK("it lists file formats, but is not an image plugin");
}
