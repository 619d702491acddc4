#include "inspect/kernel_program.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>

#include "candela/kernel_language/calls.h"

namespace kl = candela::kernel_language;
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

constexpr std::string_view k_reading =
    R"(static inline Receiver read_receiver() { return Receiver{read_vec3(), read_vec3()}; }
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

/// A function that reads a call's numbers and makes the call.
std::string reading_caller(std::size_t number, std::size_t plugin_number, const PluginDescriptor& plugin,
                           const Callable& callable) {
    return kl::kernel_caller(fmt::format("called_{}", number), plugin, callable.name) +
           fmt::format(
               "static void call_{0}([[maybe_unused]] int sample) {{\n    const auto m = make_{1}();\n    "
               "{2}\n"
               "    called_{0}(m, a, b);\n}}\n",
               number, plugin_number, callable.reading);
}

float bits(std::ptrdiff_t integer) { return std::bit_cast<float>(static_cast<std::int32_t>(integer)); }

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
    text += fmt::format("}}\n#line 1 \"kernels.cpp\"{}{}", kl::kernel_reading(), k_reading);
    std::string cases;
    std::size_t number = 0;
    for (std::size_t p = 0; p < plugins_.size(); ++p) {
        text += kl::kernel_parameters_reader(fmt::format("make_{}", p), *plugins_[p]);
        for (const Callable& callable : k_callables) {
            if (kl::has_kernel_function(*plugins_[p], callable.name)) {
                text += reading_caller(number, p, *plugins_[p], callable);
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
        if (plugin == plugins_.end() || !kl::has_kernel_function(**plugin, call.function)) continue;
        const auto callable = std::ranges::find(k_callables, call.function, &Callable::name);
        const auto function =
            (plugin - plugins_.begin()) * std::ssize(k_callables) + (callable - k_callables.begin());
        for (const auto number : {static_cast<std::ptrdiff_t>(i), function,
                                  static_cast<std::ptrdiff_t>(std::max(call.sample, 0))})
            input.push_back(bits(number));
        kl::append_parameters(*call.plugin, call.values, input);
        input.insert(input.end(), call.arguments.begin(), call.arguments.end());
    }
    return input;
}
