module;

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
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

constexpr std::array<std::string_view, 3> k_relation_names = {"less", "less-or-equal", "sum-at-most-one"};

template <class Enum, std::size_t count>
std::optional<Enum> enum_named(const std::array<std::string_view, count>& names, std::string_view name) {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) return std::nullopt;
    return static_cast<Enum>(found - names.begin());
}

bool holds(const Value& value, ParamType type) {
    switch (type) {
        case ParamType::real:
            return std::holds_alternative<double>(value);
        case ParamType::integer:
            return std::holds_alternative<std::int64_t>(value);
        case ParamType::boolean:
            return std::holds_alternative<bool>(value);
        case ParamType::choice:
        case ParamType::text:
        case ParamType::file:
            return std::holds_alternative<std::string>(value);
        case ParamType::matrix:
            return std::holds_alternative<Matrix>(value);
        case ParamType::numbers: {
            const auto* const list = std::get_if<NumberList>(&value);
            return list != nullptr && !list->empty();
        }
        default:
            return std::holds_alternative<Vec3>(value);
    }
}

/// All components of a numeric value; one for a scalar.
std::vector<double> numbers_of(const Value& value) {
    if (const auto* whole = std::get_if<std::int64_t>(&value)) return {static_cast<double>(*whole)};
    if (const auto* real = std::get_if<double>(&value)) return {*real};
    if (const auto* v = std::get_if<Vec3>(&value)) return {shortest(v->x), shortest(v->y), shortest(v->z)};
    std::vector<double> numbers;
    if (const auto* rows = std::get_if<Matrix>(&value))
        std::ranges::transform(*rows, std::back_inserter(numbers), shortest);
    if (const auto* list = std::get_if<NumberList>(&value))
        std::ranges::transform(*list, std::back_inserter(numbers), shortest);
    return numbers;
}

// An excluded bound is also excluded for the resulting float: 1e-50 is not greater than 0.
bool below(double x, const Parameter& p) {
    return x < shortest(p.minimum) || (p.minimum_excluded && static_cast<float>(x) <= p.minimum);
}
bool above(double x, const Parameter& p) {
    return x > shortest(p.maximum) || (p.maximum_excluded && static_cast<float>(x) >= p.maximum);
}

}  // namespace

std::optional<ParamType> param_type_named(std::string_view name) noexcept {
    for (int type = 0; type <= static_cast<int>(ParamType::numbers); ++type) {
        if (name_of(static_cast<ParamType>(type)) == name) return static_cast<ParamType>(type);
    }
    return std::nullopt;
}
std::string_view name_of(RelationType type) noexcept {
    return k_relation_names[static_cast<std::size_t>(type)];
}
std::optional<RelationType> relation_type_named(std::string_view name) noexcept {
    return enum_named<RelationType>(k_relation_names, name);
}

Parameter parameter_of(const ParamSpec& spec) {
    Parameter result;
    result.name = spec.name;
    result.type = spec.type;
    result.unit = spec.unit;
    result.meaning = spec.meaning;
    if (!spec.required) result.default_value = value_of(spec, spec.default_value);
    result.minimum = spec.minimum;
    result.maximum = spec.maximum;
    result.minimum_excluded = spec.minimum_excluded;
    result.maximum_excluded = spec.maximum_excluded;
    result.choices.assign(spec.choices.begin(), spec.choices.end());
    return result;
}

Relation relation_of(const RelationSpec& spec) {
    return {spec.type, spec.left, spec.right, spec.only_warns, spec.meaning};
}

Preset preset_of(const PresetSpec& spec, std::span<const ParamSpec> parameters) {
    Preset result{.name = spec.name, .source = spec.source, .values = {}, .color = {}};
    for (const PresetValue& preset : spec.values) {
        const auto named = [&](const ParamSpec& p) { return std::string_view(p.name) == preset.parameter; };
        const auto found = std::ranges::find_if(parameters, named);
        if (found == parameters.end())
            throw Error(ErrorCategory::failure,
                        fmt::format("preset '{}' sets '{}', but there is no such parameter", spec.name,
                                    preset.parameter));
        result.values.emplace_back(preset.parameter, value_of(*found, preset.value));
    }
    if (spec.has_color) result.color = Vec3{spec.color[0], spec.color[1], spec.color[2]};
    return result;
}

std::string text_of(const Relation& r) {
    switch (r.type) {
        case RelationType::less:
            return fmt::format("{} is less than {}: {}", r.left, r.right, r.meaning);
        case RelationType::less_or_equal:
            return fmt::format("{} does not exceed {}: {}", r.left, r.right, r.meaning);
        case RelationType::sum_at_most_one:
            break;
    }
    return fmt::format("{} and {} together are at most 1{}: otherwise {}", r.left, r.right,
                       r.only_warns ? " (a warning)" : "", r.meaning);
}

std::string range_text(const Parameter& p) {
    const bool has_minimum = p.minimum != k_no_minimum;
    const bool has_maximum = p.maximum != k_no_maximum;
    if (has_minimum && has_maximum) {
        if (!p.minimum_excluded && !p.maximum_excluded) return fmt::format("{} to {}", p.minimum, p.maximum);
        return fmt::format("{} {} and {} {}", p.minimum_excluded ? "greater than" : "at least", p.minimum,
                           p.maximum_excluded ? "less than" : "at most", p.maximum);
    }
    if (has_minimum) return fmt::format("{} {}", p.minimum_excluded ? "greater than" : "at least", p.minimum);
    if (has_maximum) return fmt::format("{} {}", p.maximum_excluded ? "less than" : "at most", p.maximum);
    return "";
}

namespace {

/// The other ways to write a number: `, or "EV 12"`.
std::string_view notation_text(Notation notation) {
    switch (notation) {
        case Notation::plain:
            break;
        case Notation::exposure:
            return ", or \"EV 12\", or { aperture = 8, time = 0.008, iso = 200 }";
        case Notation::intensity:
        case Notation::cone:
            return R"(, or "800 lm", "1200 cd" or "60 W")";
        case Notation::illuminance:
            return ", or \"5 klx\"";
    }
    return "";
}

}  // namespace

std::string constraint_text(const Parameter& p) {
    const std::string range = range_text(p);
    const std::string tail = range.empty() ? "" : ", " + range;
    switch (p.type) {
        case ParamType::real:
            return fmt::format("a number{}{}", tail, notation_text(p.notation));
        case ParamType::integer:
            if (!p.choices.empty()) return fmt::format("one of {}", fmt::join(p.choices, ", "));
            return "an integer" + tail;
        case ParamType::boolean:
            return "true or false";
        case ParamType::choice:
            return fmt::format("one of '{}'", fmt::join(p.choices, "', '"));
        case ParamType::text:
            return "a quoted string";
        case ParamType::file:
            return "a quoted path";
        case ParamType::vector:
            return "three numbers" + (range.empty() ? "" : ", each " + range);
        case ParamType::point:
            return "three numbers, a position in metres";
        case ParamType::direction:
            return "three numbers, not all zero";
        case ParamType::color:
            return "three integers 0-255";
        case ParamType::rgb:
            return "a number, or three of them" + tail;
        case ParamType::matrix:
            return "three rows of three numbers" + (range.empty() ? "" : ", each " + range);
        case ParamType::numbers:
            return "a list of at least one number" + (range.empty() ? "" : ", each " + range);
    }
    return "a value";
}

std::optional<std::string> validation_error(const Parameter& p, const Value& value,
                                            std::string_view written) {
    const auto text = [&] { return written.empty() ? text_of(value) : std::string(written); };
    const auto number = [&](double x) {
        return written.empty() ? fmt::format("{}", x) : std::string(written);
    };
    if (p.type == ParamType::choice) {
        const auto* word = std::get_if<std::string>(&value);
        if (word == nullptr || std::ranges::find(p.choices, *word) == p.choices.end()) {
            return fmt::format("{} is not {}", text(), constraint_text(p));
        }
        return std::nullopt;
    }
    if (p.type == ParamType::integer && !p.choices.empty() &&
        std::ranges::find(p.choices, text_of(value)) == p.choices.end()) {
        return fmt::format("{} is not one of {}", text(), fmt::join(p.choices, ", "));
    }
    for (const double x : numbers_of(value)) {
        if (!std::isfinite(x)) return fmt::format("{} is not a usable number", number(x));
        if (std::abs(x) > static_cast<double>(std::numeric_limits<float>::max())) {
            return fmt::format("{} is too large (at most {:.3g})", number(x),
                               std::numeric_limits<float>::max());
        }
        if (p.type == ParamType::color ? (x < 0 || x > 256) : (below(x, p) || above(x, p))) {
            const std::string allowed = p.type == ParamType::color ? "0 to 255" : range_text(p);
            return fmt::format("{} is outside its range: {}", text(), allowed);
        }
        if (p.type == ParamType::integer && std::abs(x) > std::numeric_limits<std::int32_t>::max()) {
            return fmt::format("{} is too large (at most {})", text(),
                               std::numeric_limits<std::int32_t>::max());
        }
    }
    if (p.type == ParamType::direction && std::get<Vec3>(value) == Vec3{}) {
        return "a direction cannot be zero";
    }
    return std::nullopt;
}

ParamSet::ParamSet() {
    static const auto k_empty = std::make_shared<const std::vector<Parameter>>();
    schema_ = k_empty;
}

ParamSet::ParamSet(std::vector<Parameter> schema)
    : ParamSet(std::make_shared<const std::vector<Parameter>>(std::move(schema))) {}

ParamSet::ParamSet(SharedSchema schema) : schema_(std::move(schema)) {
    values_.reserve(schema_->size());
    for (const Parameter& p : *schema_) values_.push_back(p.default_value);
}

bool operator==(const ParamSet& a, const ParamSet& b) {
    return (a.schema_ == b.schema_ || *a.schema_ == *b.schema_) && a.values_ == b.values_;
}

std::size_t ParamSet::index_of(std::string_view name) const noexcept {
    const auto found = std::ranges::find_if(*schema_, [&](const Parameter& p) { return p.name == name; });
    return static_cast<std::size_t>(found - schema_->begin());
}

void ParamSet::set(std::string_view name, Value value) {
    const std::size_t index = index_of(name);
    if (index == schema_->size()) throw std::invalid_argument(fmt::format("no parameter '{}'", name));
    const ParamType type = (*schema_)[index].type;
    if (const auto* whole = std::get_if<std::int64_t>(&value);
        whole != nullptr && (type == ParamType::real || type == ParamType::rgb)) {
        value = static_cast<double>(*whole);
    }
    if (const auto* one = std::get_if<double>(&value); one != nullptr && type == ParamType::rgb) {
        const auto x = static_cast<float>(*one);
        value = Vec3{x, x, x};
    }
    if (!holds(value, type)) {
        throw std::invalid_argument(fmt::format("{} for '{}': expected {}", text_of(value), name,
                                                constraint_text((*schema_)[index])));
    }
    if (const auto wrong = validation_error((*schema_)[index], value)) {
        throw std::invalid_argument(fmt::format("'{}': {}", name, *wrong));
    }
    values_[index] = std::move(value);
}

const Value& ParamSet::get(std::string_view name) const {
    const std::size_t index = index_of(name);
    if (index == schema_->size() || !values_[index])
        throw std::invalid_argument(fmt::format("'{}' has no value", name));
    return *values_[index];
}

std::vector<ParamValue> ParamSet::runtime(ColorEncoding encoding) const {
    std::vector<ParamValue> result;
    for (std::size_t i = 0; i < schema_->size(); ++i) {
        const Parameter& p = (*schema_)[i];
        if (!values_[i]) throw std::invalid_argument(fmt::format("'{}' must be given", p.name));
        ParamValue& value = result.emplace_back(written_value(*values_[i], p));
        const auto put = [&](float x, float y, float z) {
            std::ranges::copy(std::array{x, y, z}, value.number);
        };
        if (p.type == ParamType::real && p.unit == "deg") {
            value.number[0] *= 0.0174532925f;
        } else if (p.type == ParamType::color) {
            const Rgb rgb = decoded(std::get<Vec3>(*values_[i]), encoding);
            put(rgb.r, rgb.g, rgb.b);
        } else if (p.type == ParamType::direction) {
            const Vec3 unit = normalized(std::get<Vec3>(*values_[i]));
            put(unit.x, unit.y, unit.z);
        }
    }
    return result;
}

std::optional<std::string> validation_error(const Relation& relation, const ParamSet& set) {
    const std::size_t left_index = set.index_of(relation.left);
    const std::size_t right_index = set.index_of(relation.right);
    if (left_index == set.schema().size() || right_index == set.schema().size()) return std::nullopt;
    if (!set.get(left_index) || !set.get(right_index)) return std::nullopt;
    const std::vector<double> left = numbers_of(*set.get(left_index));
    const std::vector<double> right = numbers_of(*set.get(right_index));
    for (std::size_t i = 0; i < std::min(left.size(), right.size()); ++i) {
        const auto sentence = [&](std::string_view must) {
            return fmt::format("{} ({}) must {} {} ({}): {}", relation.left, left[i], must, relation.right,
                               right[i], relation.meaning);
        };
        switch (relation.type) {
            case RelationType::less:
                if (!(left[i] < right[i])) return sentence("be less than");
                break;
            case RelationType::less_or_equal:
                if (!(left[i] <= right[i])) return sentence("not exceed");
                break;
            case RelationType::sum_at_most_one:
                // A small tolerance: as floats, 0.7 + 0.3 exceeds one.
                if (left[i] + right[i] > 1 + 1e-6) {
                    return fmt::format("{} + {} is {:.6g}, more than 1: {}", relation.left, relation.right,
                                       left[i] + right[i], relation.meaning);
                }
                break;
        }
    }
    return std::nullopt;
}

}  // namespace candela
