// Checks of what a kernel file's comments declare.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "candela/kernel_language/declarations.h"
#include "candela/material_presets.h"
#include "documentation.h"
#include "tokens.h"

import candela.api;
import candela.plugins;

namespace candela::kernel_language {

namespace {

/// Numbers as written, as a value of the parameter; Refusal if there cannot be such a value.
Value value_of(const ParameterDeclaration& parameter, std::vector<float> numbers, TextPosition place) {
    const auto require_count = [&](std::size_t count) {
        if (numbers.size() != count)
            throw Refusal{place, fmt::format("'{}' takes {} {}, got {}", parameter.name, count,
                                             count == 1 ? "number" : "numbers", numbers.size())};
    };
    switch (parameter.type) {
        case ParamType::real:
            require_count(1);
            return shortest(numbers[0]);
        case ParamType::integer: {
            require_count(1);
            const auto number = static_cast<double>(numbers[0]);
            if (number != std::floor(number) || std::abs(number) > std::numeric_limits<std::int32_t>::max())
                throw Refusal{
                    place, fmt::format("'{}' is an integer, which cannot be {}", parameter.name, numbers[0])};
            return static_cast<std::int64_t>(number);
        }
        case ParamType::boolean:
            require_count(1);
            return numbers[0] != 0;
        case ParamType::matrix: {
            require_count(9);
            Matrix rows{};
            std::ranges::copy(numbers, rows.begin());
            return rows;
        }
        case ParamType::numbers:
            return NumberList(std::move(numbers));
        case ParamType::choice:
            throw Refusal{place, fmt::format("'{}' is one of several words, and a preset has only numbers",
                                             parameter.name)};
        default:
            if (parameter.type == ParamType::rgb && numbers.size() == 1) numbers.resize(3, numbers[0]);
            require_count(3);
            return Vec3{numbers[0], numbers[1], numbers[2]};
    }
}

Parameter parameter_of(const ParameterDeclaration& declared) {
    Parameter parameter{.name = declared.name,
                        .type = declared.type,
                        .unit = declared.unit,
                        .meaning = declared.meaning,
                        .minimum = declared.minimum,
                        .maximum = declared.maximum,
                        .minimum_excluded = declared.minimum_excluded,
                        .maximum_excluded = declared.maximum_excluded,
                        .choices = declared.choices};
    if (declared.type == ParamType::choice)
        parameter.default_value = declared.choices.front();
    else if (!declared.is_required)
        parameter.default_value = value_of(declared, declared.numbers, declared.default_place);
    return parameter;
}

class DeclarationChecker {
  public:
    explicit DeclarationChecker(const ModelDeclaration& model) : model_(model) {}

    void check() {
        std::vector<Parameter> parameters;
        for (const ParameterDeclaration& declared : model_.parameters) {
            parameters.push_back(parameter_of(declared));
            check(declared, parameters.back());
        }
        parameters_ = std::make_shared<const std::vector<Parameter>>(std::move(parameters));
        for (const RelationDeclaration& declared : model_.relations) check(declared);
        check_properties();
        check_presets();
        if (!model_.rate.empty() && model_.kind != PluginKind::shading)
            throw Refusal{model_.rate_place, "only a shading model has a rate"};
    }

  private:
    void check_properties() const {
        std::set<std::string> properties;
        for (const PropertyDeclaration& declared : model_.properties) {
            if (!properties.insert(declared.name).second)
                throw Refusal{declared.place, fmt::format("'{}' is declared already", declared.name)};
            if (const auto problem =
                    property_problem(model_.kind, declared.name, declared.value, parameters_))
                throw Refusal{declared.place, *problem};
        }
    }

    void check(const ParameterDeclaration& declared, const Parameter& parameter) const {
        if (const auto problem = parameter_name_problem(model_.kind, declared.name))
            throw Refusal{declared.place, *problem};
        const bool is_empty =
            declared.minimum > declared.maximum || (declared.minimum == declared.maximum &&
                                                    (declared.minimum_excluded || declared.maximum_excluded));
        if (is_empty || std::isnan(declared.minimum) || std::isnan(declared.maximum))
            throw Refusal{declared.range_place,
                          fmt::format("the range of '{}' is empty: from {} to {}", declared.name,
                                      declared.minimum, declared.maximum)};
        for (auto choice = declared.choices.begin(); choice != declared.choices.end(); ++choice)
            if (std::find(declared.choices.begin(), choice, *choice) != choice)
                throw Refusal{declared.default_place, fmt::format("'{}' is a choice already", *choice)};
        if (!parameter.default_value) return;
        if (const auto problem = validation_error(parameter, *parameter.default_value))
            throw Refusal{declared.default_place,
                          fmt::format("the default of '{}': {}", declared.name, *problem)};
    }

    void check(const RelationDeclaration& declared) {
        const Relation& relation = relations_.emplace_back(
            Relation{declared.type, declared.left, declared.right, declared.only_warns, declared.meaning});
        if (const auto problem = relation_problem(relation, parameters_))
            throw Refusal{declared.place, *problem};
        if (const auto problem = validation_error(relation, ParamSet(parameters_)))
            throw Refusal{declared.place, "the defaults: " + *problem};
    }

    void check_presets() const {
        std::set<std::string> names;
        for (const PresetDeclaration& declared : model_.presets) {
            Preset preset{.name = declared.name, .source = declared.source, .values = {}, .color = {}};
            for (const auto& [name, numbers] : declared.values) {
                const auto parameter =
                    std::ranges::find(model_.parameters, name, &ParameterDeclaration::name);
                preset.values.emplace_back(name, parameter == model_.parameters.end()
                                                     ? Value()
                                                     : value_of(*parameter, numbers, declared.place));
            }
            if (declared.color) {
                if (declared.color->size() != 3)
                    throw Refusal{declared.place, "a colour is three integers 0-255"};
                preset.color = Vec3{(*declared.color)[0], (*declared.color)[1], (*declared.color)[2]};
            }
            if (!names.insert(preset.name).second)
                throw Refusal{declared.place, fmt::format("there is a preset '{}' already", preset.name)};
            check(preset, declared.place);
        }
        if (model_.preset_set == "classic") check_all(sdk::k_classic_presets);
        if (model_.preset_set == "metals") check_all(sdk::k_metal_presets);
    }

    /// A set that several models share.
    void check_all(std::span<const PresetSpec> presets) const {
        const TextPosition place = model_.preset_set_place;
        if (!model_.presets.empty())
            throw Refusal{place, "a model has presets of its own or a set of others, not both"};
        for (const PresetSpec& spec : presets) {
            Preset preset{.name = spec.name, .source = spec.source, .values = {}, .color = {}};
            for (const PresetValue& each : spec.values) {
                const auto parameter =
                    std::ranges::find(*parameters_, std::string_view(each.parameter), &Parameter::name);
                const auto& number = each.value.number;
                const bool is_real = parameter != parameters_->end() && parameter->type == ParamType::real;
                if (!is_real && (parameter == parameters_->end() || parameter->type != ParamType::rgb))
                    throw Refusal{place,
                                  fmt::format("the presets '{}' need a parameter '{}', a vec3 or a float",
                                              model_.preset_set, each.parameter)};
                preset.values.emplace_back(
                    each.parameter,
                    is_real ? Value(shortest(number[0])) : Value(Vec3{number[0], number[1], number[2]}));
            }
            check(preset, place);
        }
    }

    void check(const Preset& preset, TextPosition place) const {
        const auto problems = preset_problems(preset, model_.kind, parameters_, relations_);
        if (!problems.empty()) throw Refusal{place, problems.front()};
    }

    const ModelDeclaration& model_;
    SharedSchema parameters_;
    std::vector<Relation> relations_;
};

}  // namespace

void check_declarations(const ModelDeclaration& model) { DeclarationChecker(model).check(); }

}  // namespace candela::kernel_language
