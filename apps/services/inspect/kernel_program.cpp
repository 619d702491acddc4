#include "inspect/kernel_program.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>

using candela::KernelFunction;
using candela::ParamSpec;
using candela::ParamType;
using candela::ParamValue;
using candela::PluginDescriptor;

namespace {

/// A function to call, and how to read its arguments a and b.
struct Callable {
    std::string_view name, reading;
};

constexpr std::array<Callable, 5> k_callables{{
    {"normal", "const auto a = read_shading_point(); const auto b = read_triangle();"},
    {"illuminate", "const auto a = read_receiver(); const int b = sample;"},
    {"illuminate_ambient", "const auto a = read_receiver(); const int b = sample;"},
    {"reflect", "const auto a = read_surface(); const auto b = read_vec3();"},
    {"reflect_ambient", "const auto a = read_surface(); const int b = sample;"},
}};

// The function's possible arguments, with m as the model's parameters; the first combination that fits is
// used.
constexpr std::array<std::string_view, 4> k_fitting{"m, a, b", "m, a", "a, b", "a"};

// Braces, because their contents are evaluated in order.
constexpr std::string_view k_reading = R"(
using namespace candela::kernel;
static const float* at;
static inline float read_real() { return *at++; }
static inline int read_integer() { return __builtin_bit_cast(int, *at++); }
static inline vec2 read_vec2() { return vec2{read_real(), read_real()}; }
static inline vec3 read_vec3() { return vec3{read_real(), read_real(), read_real()}; }
static inline mat3 read_mat3() { return mat3{read_vec3(), read_vec3(), read_vec3()}; }
static inline Receiver read_receiver() { return Receiver{read_vec3(), read_vec3()}; }
static inline Surface read_surface() {
    return Surface{read_vec3(), read_vec3(), read_vec3(), read_vec3(), read_vec3(), read_vec2()};
}
static inline ShadingPoint read_shading_point() {
    return ShadingPoint{read_vec3(), read_vec3(), read_vec3(), read_vec2(), read_vec3(), read_vec3()};
}
static inline Triangle read_triangle() {
    return Triangle{read_vec3(), read_vec3(), read_vec3(), read_vec3(), read_vec3(), read_vec3()};
}
)";

bool has(const PluginDescriptor& plugin, std::string_view function) {
    return plugin.kernel.text != nullptr &&
           std::ranges::any_of(plugin.kernel.functions,
                               [&](const KernelFunction& each) { return each.name == function; });
}

bool has_parameters(const PluginDescriptor& plugin) { return *plugin.kernel.parameters != '\0'; }

bool is_list(ParamType type) {
    return type == ParamType::text || type == ParamType::file || type == ParamType::numbers;
}

bool is_integer(ParamType type) {
    return type == ParamType::integer || type == ParamType::boolean || type == ParamType::choice;
}

/// A function that reads the kernel's struct; its members have the names of the parameters (see KernelText).
std::string maker(std::size_t number, const PluginDescriptor& plugin) {
    const candela::KernelText& kernel = plugin.kernel;
    if (!has_parameters(plugin)) return fmt::format("static int make_{}() {{ return 0; }}\n", number);
    std::string members;
    for (const std::size_t i : kernel.members) {
        const ParamSpec& parameter = plugin.parameters[i];
        if (is_list(parameter.type)) {
            members += fmt::format(
                "    if (const int count = read_integer(); count > 0) {{ m.{} = Table{{at, count}}; at += "
                "count; }}\n",
                parameter.name);
        } else {
            const char* const kind = is_integer(parameter.type)            ? "integer"
                                     : parameter.type == ParamType::real   ? "real"
                                     : parameter.type == ParamType::matrix ? "mat3"
                                                                           : "vec3";
            members += fmt::format("    m.{} = read_{}();\n", parameter.name, kind);
        }
    }
    return fmt::format("static auto make_{}() {{\n    {} m;\n{}    return {};\n}}\n", number,
                       kernel.parameters, members,
                       has(plugin, "prepare") ? fmt::format("{}_prepare(m)", kernel.prefix) : "m");
}

/// A function that reads a call's numbers and makes the call. It does so in a template, where a call that
/// does not fit is not an error.
std::string caller(std::size_t number, std::size_t plugin_number, const PluginDescriptor& plugin,
                   const Callable& callable) {
    const std::string name = fmt::format("{}_{}", plugin.kernel.prefix, callable.name);
    std::string attempts;
    for (const std::string_view arguments : k_fitting)
        attempts +=
            fmt::format("if constexpr (requires {{ {0}({1}); }}) {0}({1});\n        else ", name, arguments);
    return fmt::format(
        "static void call_{}([[maybe_unused]] int sample) {{\n    const auto m = make_{}();\n    {}\n"
        "    [](auto m, auto a, auto b) {{\n        {}static_assert(sizeof m == 0);\n    }}(m, a, b);\n}}\n",
        number, plugin_number, callable.reading, attempts);
}

float bits(std::int32_t integer) { return std::bit_cast<float>(integer); }

void add_values(const KernelCall& call, std::vector<float>& input) {
    if (!has_parameters(*call.plugin)) return;
    for (const std::size_t i : call.plugin->kernel.members) {
        const ParamType type = call.plugin->parameters[i].type;
        const ParamValue& value = call.values[i];
        if (is_list(type)) {
            input.push_back(bits(static_cast<std::int32_t>(value.list.size())));
            input.insert(input.end(), value.list.begin(), value.list.end());
        } else if (is_integer(type)) {
            input.push_back(bits(value.integer));
        } else if (type == ParamType::real) {
            input.push_back(value.number[0]);
        } else if (type == ParamType::matrix) {
            for (const std::size_t c : {0, 1, 2})  // column by column
                input.insert(input.end(), {value.number[c], value.number[c + 3], value.number[c + 6]});
        } else {
            input.insert(input.end(), {value.number[0], value.number[1], value.number[2]});
        }
    }
}

}  // namespace

KernelProgram::KernelProgram(std::vector<const PluginDescriptor*> plugins) : plugins_(std::move(plugins)) {
    std::erase_if(plugins_, [](const PluginDescriptor* plugin) { return plugin->kernel.text == nullptr; });
}

std::string KernelProgram::traced_prelude(const std::string& prelude) {
    return kernels_.traced(prelude, "prelude.kernel");
}

std::string KernelProgram::source() {
    std::string text = fmt::format("{}#include \"candela/kernel/kernel.h\"\nnamespace candela::kernel {{\n",
                                   kernel_trace_prelude());
    for (const PluginDescriptor* const plugin : plugins_) {
        const std::string file = std::string(plugin->name) + ".kernel";
        text += fmt::format("#line 1 \"{}\"\n{}\n", file, kernels_.traced(plugin->kernel.text, file));
    }
    text += fmt::format("}}\n#line 1 \"kernels.cpp\"{}", k_reading);
    std::string cases;
    std::size_t number = 0;
    for (std::size_t p = 0; p < plugins_.size(); ++p) {
        text += maker(p, *plugins_[p]);
        for (const Callable& callable : k_callables) {
            if (has(*plugins_[p], callable.name)) {
                text += caller(number, p, *plugins_[p], callable);
                cases += fmt::format("            case {0}: call_{0}(sample); break;\n", number);
            }
            ++number;
        }
    }
    return text + fmt::format(R"(int main(int, char** words) {{
    std::FILE* const file = std::fopen(words[1], "rb");
    if (file == nullptr) return 1;
    std::string bytes;
    char part[4096];
    while (const std::size_t size = std::fread(part, 1, sizeof part, file)) bytes.append(part, size);
    at = reinterpret_cast<const float*>(bytes.data());
    const float* const end = at + bytes.size() / sizeof(float);
    while (at < end) {{
        const int call = read_integer(), function = read_integer();
        [[maybe_unused]] const int sample = read_integer();
        std::printf("call %d\n", call);
        switch (function) {{
{}            default: return 1;
        }}
    }}
}}
)",
                              cases);
}

std::vector<float> KernelProgram::input(const std::vector<KernelCall>& calls) const {
    std::vector<float> input;
    for (std::size_t i = 0; i < calls.size(); ++i) {
        const KernelCall& call = calls[i];
        const auto plugin = std::ranges::find(plugins_, call.plugin);
        if (plugin == plugins_.end() || !has(**plugin, call.function)) continue;
        const auto callable = std::ranges::find(k_callables, call.function, &Callable::name);
        const auto function =
            (plugin - plugins_.begin()) * std::ssize(k_callables) + (callable - k_callables.begin());
        for (const auto number : {static_cast<std::ptrdiff_t>(i), function,
                                  static_cast<std::ptrdiff_t>(std::max(call.sample, 0))})
            input.push_back(bits(static_cast<std::int32_t>(number)));
        add_values(call, input);
        input.insert(input.end(), call.arguments.begin(), call.arguments.end());
    }
    return input;
}
