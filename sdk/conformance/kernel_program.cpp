#include "kernel_program.h"

#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <memory>
#include <span>
#include <sstream>
#include <string_view>
#include <system_error>
#include <vector>

#include "candela/kernel_language/calls.h"
#include "candela/kernel_language/compiler.h"
#include "process/process.h"

import candela.api;
import candela.util;

namespace fs = std::filesystem;
namespace kl = candela::kernel_language;
using candela::PluginKind;

namespace {

/// The arguments of one point's call, after the parameters, and the destination of its result; the arrays are
/// those of batch.h.
std::string body_of(PluginKind kind) {
    namespace in = inputs;
    const auto three = [](const char* array, std::size_t first) {
        return fmt::format("vec3({0}[{1}][i], {0}[{2}][i], {0}[{3}][i])", array, first, first + 1, first + 2);
    };
    const auto put = [](std::size_t first, const std::string& value) {
        return fmt::format("{{ const vec3 v = {}; out[{}][i] = v.x; out[{}][i] = v.y; out[{}][i] = v.z; }}\n",
                           value, first, first + 1, first + 2);
    };
    const auto function = [](const std::string& name, const std::string& before, const std::string& call,
                             const std::string& after) {
        return fmt::format(
            "extern \"C\" void run_{}(const float* parameters, [[maybe_unused]] int sample, unsigned long "
            "count, "
            "const float* const* in, float* const* out) {{\n    at = parameters;\n    const auto m = "
            "make_parameters();\n    for (unsigned long i = 0; i < count; ++i) {{\n        {}        {}\n"
            "        {}    }}\n}}\n",
            name, before, call, after);
    };
    const std::string surface =
        fmt::format("Surface s{{{}, {}, {}, {}, {}, vec2(in[{}][i], in[{}][i])}};\n",
                    three("in", in::k_normal), three("in", in::k_observer), three("in", in::k_tangent),
                    three("in", in::k_color), three("in", in::k_position), in::k_uv, in::k_uv + 1);
    const std::string receiver =
        fmt::format("Receiver s{{{}, {}}};\n", three("in", in::k_position), three("in", in::k_normal));
    switch (kind) {
        case PluginKind::reflection:
            return function("reflect", surface,
                            fmt::format("const auto r = call_reflect(m, s, {});", three("in", in::k_light)),
                            put(3, "r.diffuse * " + three("in", in::k_diffuse)) +
                                put(6, "r.specular * " + three("in", in::k_specular))) +
                   function("reflect_ambient", surface, "const auto r = call_reflect_ambient(m, s, 0);",
                            put(0, "r * " + three("in", in::k_diffuse)));
        case PluginKind::light:
            if (subject().has_ambient) {
                return function("illuminate_ambient", receiver,
                                "const auto r = call_illuminate_ambient(m, s, sample);", put(0, "r"));
            }
            return function("illuminate", receiver, "const auto r = call_illuminate(m, s, sample);",
                            put(0, "r.to_light") + put(3, "r.diffuse") + put(6, "r.specular"));
        case PluginKind::shading: {
            std::string point = fmt::format(
                "ShadingPoint s{{{}, {}, {}, vec2(in[{}][i], in[{}][i]), {}, {}}};\n",
                three("in", in::k_normal), three("in", in::k_vertex_normal), three("in", in::k_barycentric),
                in::k_uv, in::k_uv + 1, three("in", in::k_dpdu), three("in", in::k_dpdv));
            if (!subject().shading_needs.triangle)
                return function("normals", point, "const auto r = call_normal(m, s, 0);", put(0, "r"));
            std::string corners;
            for (const std::size_t first : {in::k_corner_positions, in::k_corner_normals}) {
                for (std::size_t k = 0; k < 3; ++k)
                    corners += (corners.empty() ? "" : ", ") + three("in", first + 3 * k);
            }
            point += fmt::format("Triangle t{{{}}};\n", corners);
            return function("normals", point, "const auto r = call_normal(m, s, t);", put(0, "r"));
        }
        default:
            return function("position", "", "const auto r = call_position(m, in[0][i], in[1][i]);",
                            put(0, "r"));
    }
}

/// The code that the kit adds to the kernel's text, as compiler messages name it.
constexpr const char* k_calls_file = "the kit's calls of it";

/// The whole program.
std::string source(const std::string& kernel_text) {
    std::string text = fmt::format(
        "#include \"candela/kernel/kernel.h\"\n"
        "#pragma GCC diagnostic ignored \"-Wunused-parameter\"\n"
        "namespace candela::kernel {{\n#line 1 \"{}\"\n{}\n#line 1 \"{}\"\n}}\n{}{}",
        kernel_file_name(), kernel_text, k_calls_file, kl::kernel_reading(),
        kl::kernel_parameters_reader("make_parameters", subject()));
    for (const char* const function :
         {"reflect", "reflect_ambient", "illuminate", "illuminate_ambient", "normal", "position"})
        text += kl::kernel_caller(fmt::format("call_{}", function), subject(), function);
    return text + body_of(subject_manifest().kind);
}

/// The lines of a compiler's log that are wanted, few enough to read, each after a line break.
std::string shown_lines(const std::string& log, const std::function<bool(const std::string&)>& is_wanted) {
    std::string shown;
    for (const std::string& line : kl::lines_of(log, 4, is_wanted)) shown += "\n" + line;
    return shown;
}

std::shared_ptr<candela::Instance> instance_of(const Values& values) {
    switch (subject_manifest().kind) {
        case PluginKind::light:
            return make<candela::Light>(values);
        case PluginKind::reflection:
            return make<candela::ReflectionModel>(values);
        case PluginKind::shading:
            return make<candela::ShadingModel>(values);
        default:
            return make<candela::Shape>(values);
    }
}

}  // namespace

std::string kernel_file_name() { return subject_manifest().name + ".kernel"; }

std::vector<float> kernel_parameters(const Values& values) {
    std::vector<candela::ParamValue> all = values.set.runtime(candela::ColorEncoding::none);
    const auto instance = instance_of(values);
    for (const std::size_t i : subject().kernel.members) all[i].list = instance->table(i);
    std::vector<float> numbers;
    kl::append_parameters(subject(), all, numbers);
    return numbers;
}

CompiledKernel::CompiledKernel(const std::string& text, KernelAuthor author) {
    const auto compiler = candela::cxx_compiler();
    if (!compiler) SKIP("no C++ compiler is installed");
    const fs::path include = kl::kernel_headers();
    if (include.empty()) SKIP("Candela's headers are not installed with the kit");
    const fs::path file = folder_.path() / "kernel.cpp";
    std::ofstream(file) << source(text);
    // The process that loads it already contains what it needs from libraries.
    std::vector<std::string> options{"-O1",   "-fPIC",   "-shared",          "-nostdlib",
                                     "-Wall", "-Wextra", "-ffp-contract=off"};
    // Makes uninitialised local variables NaN; g++ 11 does not have this option.
    if (compiler->filename().string().find("clang") != std::string::npos)
        options.emplace_back("-ftrivial-auto-var-init=pattern");
    // An infinite loop must be detected; the compiler must not assume that it ends.
    options.emplace_back("-fno-finite-loops");
    // From overflow being undefined, a compiler would conclude that an index is in range.
    if (author == KernelAuthor::anybody)
        options.insert(options.end(), {"-fwrapv", "-fstack-clash-protection"});
    options.insert(options.end(), {"-isystem", include.string()});
    const kl::CompilerReport report = kl::compile(
        *compiler, {.options = options, .inputs = {file}, .output = library(), .temporary = folder_.path()});
    if (!report.is_success) {
        const std::string errors = shown_lines(
            report.log, [](const std::string& line) { return line.find("error") != std::string::npos; });
        throw KernelRefused(fmt::format("the kernel's text does not compile as C++ ({}):{}",
                                        compiler->string(),
                                        errors.empty() ? "\n" + report.log.substr(0, 400) : errors));
    }
    const auto warnings = [&](bool of_unused) {
        return shown_lines(report.log, [&](const std::string& line) {
            const bool is_unused = line.find("[-Wunused") != std::string::npos;
            return line.find(": warning: ") != std::string::npos &&
                   line.starts_with(kernel_file_name() + ":") && is_unused == of_unused;
        });
    };
    warnings_ = warnings(false);
    unused_ = warnings(true);
}

KernelProgram::KernelProgram() try : compiled_(subject().kernel.text, KernelAuthor::of_the_plugin) {
    library_.load(compiled_.library(), boost::dll::load_mode::rtld_now | boost::dll::load_mode::rtld_local);
} catch (const KernelRefused& problem) {
    FAIL(problem.what());
} catch (const std::system_error& problem) {
    FAIL("the compiled kernel cannot be loaded: " << problem.what());
}

KernelFunctionPointer KernelProgram::function(const std::string& name) const {
    const std::string symbol = "run_" + name;
    if (!library_.has(symbol)) FAIL("the kernel has no function for " << name);
    return &library_.get<std::remove_pointer_t<KernelFunctionPointer>>(symbol);
}

void KernelProgram::run(const std::string& call, const Values& values, int sample, const Arrays& in,
                        Arrays& out) const {
    const std::vector<float> parameters = kernel_parameters(values);
    std::vector<const float*> from;
    std::vector<float*> to;
    for (std::size_t a = 0; a < in.arrays(); ++a) from.push_back(in[a]);
    for (std::size_t a = 0; a < out.arrays(); ++a) to.push_back(out[a]);
    function(call)(parameters.data(), sample, in.count(), from.data(), to.data());
}

candela::Vec3 KernelProgram::position(const Values& values, float u, float v) const {
    Arrays in(2, 1), out(3, 1);
    in[0][0] = u;
    in[1][0] = v;
    run("position", values, 0, in, out);
    return out.at(0, 0);
}
