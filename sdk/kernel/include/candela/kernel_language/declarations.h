// The rules for the declarations of a plugin: kernel files are held to them when they are read, and every
// plugin by the conformance kit.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

import candela.api;
import candela.plugins;

namespace candela::kernel_language {

/// The part of a condition on a property, "where form is disc or ring and shininess is at least 1", that
/// concerns one parameter.
struct Condition {
    enum class Kind { is_one_of, is_at_least, is_at_most };
    std::string parameter;
    Kind kind = Kind::is_one_of;
    std::vector<std::string> values;
};

/// The conditions in a property's value, all of which must hold: none for "true". Throws
/// std::invalid_argument with a sentence if the value is neither.
std::vector<Condition> conditions_of(const std::string& property_value);

/// Whether all of them hold for the values. A parameter that does not exist satisfies none.
bool hold(const std::vector<Condition>& conditions, const ParamSet& values);

/// The names in a property's value, "lambert, phong".
std::vector<std::string> property_names(const std::string& property_value);

/// Why a plugin of that kind, with these parameters, cannot declare a property: "unknown property 'closd';
/// did you mean 'closed'? (known: …)".
std::optional<std::string> property_problem(PluginKind kind, const std::string& name,
                                            const std::string& value, const SharedSchema& parameters);

/// Why a scene could not set a parameter of that name.
std::optional<std::string> parameter_name_problem(PluginKind kind, std::string_view name);

/// Why a relation cannot be declared: it is about a parameter that does not exist.
std::optional<std::string> relation_problem(const Relation& relation, const SharedSchema& parameters);

/// The problems of a preset: a scene with its values must be valid. Each begins with "preset 'brass' …".
std::vector<std::string> preset_problems(const Preset& preset, PluginKind kind,
                                         const SharedSchema& parameters,
                                         const std::vector<Relation>& relations);

}  // namespace candela::kernel_language
