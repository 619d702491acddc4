#include "candela/kernel_language/calls.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace candela::kernel_language {

namespace {

/// A function's possible arguments; the first combination that fits is used. A number in place of missing
/// parameters must not be taken for an argument, so those with `a` and `b` precede those with `m` and `a`.
constexpr std::array<std::string_view, 4> k_fitting{"m, a, b", "a, b", "m, a", "a"};

bool is_list(ParamType type) {
    return type == ParamType::text || type == ParamType::file || type == ParamType::numbers;
}

bool is_integer(ParamType type) {
    return type == ParamType::integer || type == ParamType::boolean || type == ParamType::choice;
}

/// A statement that reads a member of the struct m.
std::string member_reader(const ParamSpec& parameter) {
    if (is_list(parameter.type)) {
        return fmt::format(
            "    if (const int count = read_integer(); count > 0) {{ m.{} = Table{{at, count}}; at += "
            "count; }}\n",
            parameter.name);
    }
    const char* const kind = is_integer(parameter.type)            ? "integer"
                             : parameter.type == ParamType::real   ? "real"
                             : parameter.type == ParamType::matrix ? "mat3"
                                                                   : "vec3";
    return fmt::format("    m.{} = read_{}();\n", parameter.name, kind);
}

float bits(std::size_t integer) { return std::bit_cast<float>(static_cast<std::uint32_t>(integer)); }

}  // namespace

bool has_kernel_function(const PluginDescriptor& plugin, std::string_view name) {
    return plugin.kernel.text != nullptr &&
           std::ranges::any_of(plugin.kernel.functions,
                               [&](const KernelFunction& function) { return function.name == name; });
}

// Braces, because their contents are evaluated in order.
std::string_view kernel_reading() {
    return R"(
using namespace candela::kernel;
static const float* at;
static inline float read_real() { return *at++; }
static inline int read_integer() { return __builtin_bit_cast(int, *at++); }
static inline vec2 read_vec2() { return vec2{read_real(), read_real()}; }
static inline vec3 read_vec3() { return vec3{read_real(), read_real(), read_real()}; }
static inline mat3 read_mat3() { return mat3{read_vec3(), read_vec3(), read_vec3()}; }
)";
}

std::string kernel_parameters_reader(std::string_view name, const PluginDescriptor& plugin) {
    const KernelText& kernel = plugin.kernel;
    if (*kernel.parameters == '\0') return fmt::format("static inline int {}() {{ return 0; }}\n", name);
    std::string members;
    for (const std::size_t i : kernel.members) members += member_reader(plugin.parameters[i]);
    return fmt::format(
        "static inline auto {}() {{\n    {} m;\n{}    return {};\n}}\n", name, kernel.parameters, members,
        has_kernel_function(plugin, "prepare") ? fmt::format("{}_prepare(m)", kernel.prefix) : "m");
}

std::string kernel_caller(std::string_view name, const PluginDescriptor& plugin, std::string_view function) {
    const std::string called = fmt::format("{}_{}", plugin.kernel.prefix, function);
    std::string attempts;
    for (const std::string_view arguments : k_fitting)
        attempts += fmt::format("if constexpr (requires {{ {0}({1}); }}) return {0}({1});\n    else ", called,
                                arguments);
    return fmt::format(
        "static inline auto {}([[maybe_unused]] auto m, [[maybe_unused]] auto a, [[maybe_unused]] auto b) "
        "{{\n"
        "    {}static_assert(sizeof m == 0, \"{} takes other arguments\");\n}}\n",
        name, attempts, called);
}

void append_parameters(const PluginDescriptor& plugin, std::span<const ParamValue> values,
                       std::vector<float>& numbers) {
    if (*plugin.kernel.parameters == '\0') return;
    for (const std::size_t i : plugin.kernel.members) {
        const ParamType type = plugin.parameters[i].type;
        const ParamValue& value = values[i];
        if (is_list(type)) {
            numbers.push_back(bits(value.list.size()));
            numbers.insert(numbers.end(), value.list.begin(), value.list.end());
        } else if (is_integer(type)) {
            numbers.push_back(std::bit_cast<float>(value.integer));
        } else if (type == ParamType::real) {
            numbers.push_back(value.number[0]);
        } else if (type == ParamType::matrix) {
            for (const std::size_t c : {0, 1, 2})  // column by column
                numbers.insert(numbers.end(), {value.number[c], value.number[c + 3], value.number[c + 6]});
        } else {
            numbers.insert(numbers.end(), {value.number[0], value.number[1], value.number[2]});
        }
    }
}

}  // namespace candela::kernel_language
