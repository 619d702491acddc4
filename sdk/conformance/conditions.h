// The condition on a property: "where form is disc or ring and shininess is at least 1".
#pragma once

#include <string>
#include <vector>

import candela.plugins;

/// The part of a condition that concerns one parameter.
struct Condition {
    enum class Kind { is_one_of, is_at_least, is_at_most };
    std::string parameter;
    Kind kind = Kind::is_one_of;
    std::vector<std::string> values;
};

/// The names in a property's value, "lambert, phong".
std::vector<std::string> names_in(const std::string& property_value);

/// The conditions in a property's value, all of which must hold: none for "true". Throws
/// std::invalid_argument with a sentence if the value is neither.
std::vector<Condition> conditions_of(const std::string& property_value);

/// Whether all of them hold for the values. A parameter that does not exist satisfies none.
bool hold(const std::vector<Condition>& conditions, const candela::ParamSet& values);
