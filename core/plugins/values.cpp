// Values: as users write them, as they cross the plugin's boundary, and as text.
module;

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <variant>

module candela.plugins;

import candela.api;
import candela.util;

namespace candela {

namespace {

/// `scalar` writes a number or a text.
template <class Scalar>
std::string text_with(const Value& value, Scalar scalar) {
    const auto list = [&](std::span<const float> numbers) {
        std::string all;
        for (const float x : numbers) all += (all.empty() ? "" : ", ") + scalar(x);
        return '[' + all + ']';
    };
    const auto text = [&](const auto& of) -> std::string {
        using Type = std::decay_t<decltype(of)>;
        if constexpr (std::is_same_v<Type, bool>) {
            return of ? "true" : "false";
        } else if constexpr (std::is_same_v<Type, std::int64_t>) {
            return fmt::format("{}", of);
        } else if constexpr (std::is_same_v<Type, Vec3>) {
            return list(std::array{of.x, of.y, of.z});
        } else if constexpr (std::is_same_v<Type, Matrix>) {
            const std::span<const float> all(of);
            return fmt::format("[{}, {}, {}]", list(all.first(3)), list(all.subspan(3, 3)),
                               list(all.last(3)));
        } else if constexpr (std::is_same_v<Type, NumberList>) {
            return list(of);
        } else {
            return scalar(of);
        }
    };
    return std::visit(text, value);
}

}  // namespace

double shortest(float x) {
    if (!std::isfinite(x)) return static_cast<double>(x);
    const double decimal = std::stod(fmt::format("{}", x));
    // Rarely, rounding twice yields the float's neighbour.
    return static_cast<float>(decimal) == x ? decimal : static_cast<double>(x);
}

Value value_of(const ParamSpec& spec, const ParamValue& value) {
    switch (spec.type) {
        case ParamType::real:
            return shortest(value.number[0]);
        case ParamType::integer:
            return std::int64_t{value.integer};
        case ParamType::boolean:
            return value.integer != 0;
        case ParamType::choice:
            return std::string(spec.choices[static_cast<std::size_t>(value.integer)]);
        case ParamType::text:
        case ParamType::file:
            return std::string(value.text != nullptr ? value.text : "");
        case ParamType::matrix: {
            Matrix rows{};
            std::copy_n(value.number, rows.size(), rows.begin());
            return rows;
        }
        case ParamType::numbers:
            return NumberList(value.list.begin(), value.list.end());
        default:
            return Vec3{value.number[0], value.number[1], value.number[2]};
    }
}

ParamValue written_value(const Value& value, const Parameter& parameter) {
    ParamValue result;
    if (const auto* const boolean = std::get_if<bool>(&value)) result.integer = *boolean ? 1 : 0;
    if (const auto* const whole = std::get_if<std::int64_t>(&value))
        result.integer = static_cast<std::int32_t>(*whole);
    if (const auto* const real = std::get_if<double>(&value)) result.number[0] = static_cast<float>(*real);
    if (const auto* const v = std::get_if<Vec3>(&value))
        std::ranges::copy(std::array{v->x, v->y, v->z}, result.number);
    if (const auto* const rows = std::get_if<Matrix>(&value)) std::ranges::copy(*rows, result.number);
    if (const auto* const list = std::get_if<NumberList>(&value)) result.list = *list;
    if (const auto* const text = std::get_if<std::string>(&value)) {
        if (parameter.type == ParamType::choice) {
            const auto at = std::ranges::find(parameter.choices, *text);
            result.integer = static_cast<std::int32_t>(at - parameter.choices.begin());
        } else {
            result.text = text->c_str();
        }
    }
    return result;
}

std::string text_of(const Value& value) {
    return text_with(value, [](const auto& of) {
        if constexpr (std::is_same_v<std::decay_t<decltype(of)>, std::string>)
            return fmt::format("\"{}\"", of);
        else
            return fmt::format("{}", of);
    });
}

std::string toml_text(const Value& value, ParamType type) {
    const auto* const three = std::get_if<Vec3>(&value);
    if (three != nullptr && type == ParamType::color)
        return fmt::format("[{:.0f}, {:.0f}, {:.0f}]", three->x, three->y, three->z);
    if (three != nullptr && type == ParamType::rgb && three->x == three->y && three->y == three->z)
        return toml_text(three->x);
    return text_with(value, [](const auto& of) { return toml_text(of); });
}

}  // namespace candela
