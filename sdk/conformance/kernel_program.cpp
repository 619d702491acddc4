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

import candela.api;
import candela.util;

namespace fs = std::filesystem;
using candela::Parameter;
using candela::ParamType;
using candela::PluginKind;

namespace {

constexpr std::size_t k_slots = 9;  // floats per parameter, whatever its type

/// Statements that fill the kernel's struct, whose members have the parameters' names (see KernelText).
std::string members_from_parameters() {
    std::string text;
    const std::vector<Parameter>& parameters = subject_manifest().parameters;
    for (std::size_t i = 0; i < parameters.size(); ++i) {
        const Parameter& p = parameters[i];
        const std::size_t at = k_slots * i;
        switch (p.type) {
            case ParamType::real:
                text += fmt::format("    m.{} = p[{}];\n", p.name, at);
                break;
            case ParamType::integer:
            case ParamType::boolean:
            case ParamType::choice:
                text += fmt::format("    m.{} = int(p[{}]);\n", p.name, at);
                break;
            case ParamType::text:
                break;  // the kernel language has no strings
            case ParamType::file:
            case ParamType::numbers:
                text += fmt::format(
                    "    if (sizes[{1}] > 0) m.{0}.numbers = tables[{1}], m.{0}.count = sizes[{1}];\n",
                    p.name, i);
                break;
            case ParamType::matrix:
                text += fmt::format(
                    "    m.{0} = transpose(mat3(vec3(p[{1}], p[{2}], p[{3}]), vec3(p[{4}], p[{5}], "
                    "p[{6}]), vec3(p[{7}], p[{8}], p[{9}])));\n",
                    p.name, at, at + 1, at + 2, at + 3, at + 4, at + 5, at + 6, at + 7, at + 8);
                break;
            default:
                text += fmt::format("    m.{} = vec3(p[{}], p[{}], p[{}]);\n", p.name, at, at + 1, at + 2);
        }
    }
    return text;
}

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
            "extern \"C\" void run_{}(const float* p, const float* const* tables, const int* sizes, int "
            "sample, "
            "unsigned long count, const float* const* in, float* const* out) {{\n    PARAMETERS\n    for "
            "(unsigned long i = 0; i < count; ++i) {{\n        {}    "
            "    {}\n"
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
                            fmt::format("const auto r = CALL(reflect, s, {});", three("in", in::k_light)),
                            put(3, "r.diffuse * " + three("in", in::k_diffuse)) +
                                put(6, "r.specular * " + three("in", in::k_specular))) +
                   function("reflect_ambient", surface, "const auto r = CALL(reflect_ambient, s);",
                            put(0, "r * " + three("in", in::k_diffuse)));
        case PluginKind::light:
            if (make<candela::Light>(default_values())->has_ambient()) {
                return function("illuminate_ambient", receiver, "const auto r = CALL(illuminate_ambient, s);",
                                put(0, "r"));
            }
            return function("illuminate", receiver, "const auto r = SAMPLED(illuminate, s);",
                            put(0, "r.to_light") + put(3, "r.diffuse") + put(6, "r.specular"));
        case PluginKind::shading: {
            std::string point = fmt::format(
                "ShadingPoint s{{{}, {}, {}, vec2(in[{}][i], in[{}][i]), {}, {}}};\n",
                three("in", in::k_normal), three("in", in::k_vertex_normal), three("in", in::k_barycentric),
                in::k_uv, in::k_uv + 1, three("in", in::k_dpdu), three("in", in::k_dpdv));
            if (!make<candela::ShadingModel>(default_values())->needs().triangle)
                return function("normals", point, "const auto r = CALL(normal, s);", put(0, "r"));
            std::string corners;
            for (const std::size_t first : {in::k_corner_positions, in::k_corner_normals}) {
                for (std::size_t k = 0; k < 3; ++k)
                    corners += (corners.empty() ? "" : ", ") + three("in", first + 3 * k);
            }
            point += fmt::format("Triangle t{{{}}};\n", corners);
            return function("normals", point, "const auto r = CALL(normal, s, t);", put(0, "r"));
        }
        default:
            return function("position", "", "const auto r = CALL(position, in[0][i], in[1][i]);",
                            put(0, "r"));
    }
}

/// The code that the kit adds to the kernel's text, as compiler messages name it.
constexpr const char* k_calls_file = "the kit's calls of it";

/// The whole program. Functions are passed the parameters first, or not at all, and the sample's number last,
/// if they take it.
std::string source(const std::string& kernel_text) {
    const candela::KernelText& kernel = subject().kernel;
    const std::string parameters = kernel.parameters;
    const bool is_prepared = std::ranges::any_of(
        kernel.functions,
        [](const candela::KernelFunction& function) { return std::string_view(function.name) == "prepare"; });
    const std::string constants = is_prepared ? fmt::format("{}_prepare(m)", kernel.prefix) : "m";
    const std::string filled =
        parameters.empty()
            ? std::string("const int m = 0; (void)m; (void)p; (void)tables; (void)sizes; (void)sample;")
            : fmt::format(
                  "(void)p; (void)tables; (void)sizes; (void)sample; const auto m = [&] {{ {} m;\n{} return "
                  "{}; }}();",
                  parameters, members_from_parameters(), constants);
    const std::string text = fmt::format(
        "#include \"candela/kernel/kernel.h\"\n"
        "#pragma GCC diagnostic ignored \"-Wunused-parameter\"\n"
        "namespace candela::kernel {{\n#line 1 \"{}\"\n{}\n#line 1 \"{}\"\n}}\n"
        "using namespace candela::kernel;\n"
        "#define CALL(name, ...) [&](auto m_, auto... a) {{ \\\n"
        "    if constexpr (requires {{ {}_##name(m_, a...); }}) return {}_##name(m_, a...); \\\n"
        "    else return {}_##name(a...); }}(m, __VA_ARGS__)\n"
        "#define SAMPLED(name, s) [&](auto m_, auto a) {{ \\\n"
        "    if constexpr (requires {{ {}_##name(m_, a, sample); }}) return {}_##name(m_, a, sample); \\\n"
        "    else return CALL(name, a); }}(m, s)\n",
        kernel_file_name(), kernel_text, k_calls_file, kernel.prefix, kernel.prefix, kernel.prefix,
        kernel.prefix, kernel.prefix);
    std::string body = body_of(subject_manifest().kind);
    for (std::size_t at; (at = body.find("PARAMETERS")) != std::string::npos;) body.replace(at, 10, filled);
    return text + body;
}

/// The lines that `is_wanted` accepts, few enough to read.
std::string lines_of(const std::string& log, const std::function<bool(const std::string&)>& is_wanted) {
    std::istringstream lines(log);
    lines.exceptions(std::ios::badbit);  // otherwise std::getline() swallows std::bad_alloc, and the rest is
                                         // lost
    std::string result;
    int shown = 0;
    for (std::string line; std::getline(lines, line) && shown < 4;) {
        if (!is_wanted(line)) continue;
        result += "\n" + line;
        ++shown;
    }
    return result;
}

std::vector<float> runtime(const Values& values) {
    std::vector<float> slots;
    const auto all = values.set.runtime(candela::ColorEncoding::none);
    for (std::size_t i = 0; i < all.size(); ++i) {
        const ParamType type = subject_manifest().parameters[i].type;
        const bool is_whole =
            type == ParamType::integer || type == ParamType::boolean || type == ParamType::choice;
        slots.insert(slots.end(), std::begin(all[i].number), std::end(all[i].number));
        if (is_whole) slots[slots.size() - k_slots] = static_cast<float>(all[i].integer);
    }
    return slots;
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

fs::path sdk_include_directory() {
    std::error_code problem;
    for (fs::path above = fs::read_symlink("/proc/self/exe", problem).parent_path();
         above.has_relative_path(); above = above.parent_path()) {
        if (fs::exists(above / "include/candela/kernel/kernel.h", problem)) return above / "include";
    }
    return {};
}

KernelInputs kernel_inputs(const Values& values) {
    KernelInputs inputs{.parameters = runtime(values), .tables = {}};
    const auto instance = instance_of(values);
    for (std::size_t i = 0; i < subject_manifest().parameters.size(); ++i) {
        const std::span<const float> table = instance->table(i);
        inputs.tables.emplace_back(table.begin(), table.end());
    }
    return inputs;
}

CompiledKernel::CompiledKernel(const std::string& text, KernelAuthor author) {
    const auto compiler = candela::cxx_compiler();
    if (!compiler) SKIP("no C++ compiler is installed");
    const fs::path include = sdk_include_directory();
    if (include.empty()) SKIP("Candela's headers are not installed with the kit");
    const fs::path file = folder_.path() / "kernel.cpp";
    std::ofstream(file) << source(text);
    // The process that loads it already contains what it needs from libraries.
    std::vector<std::string> words{compiler->string(), "-std=c++20", "-O1",   "-fPIC",
                                   "-shared",          "-nostdlib",  "-Wall", "-Wextra",
                                   "-ffp-contract=off"};
    // Makes uninitialised local variables NaN; g++ 11 does not have this option.
    if (compiler->filename().string().find("clang") != std::string::npos)
        words.emplace_back("-ftrivial-auto-var-init=pattern");
    // An infinite loop must be detected; the compiler must not assume that it ends.
    words.emplace_back("-fno-finite-loops");
    // From overflow being undefined, a compiler would conclude that an index is in range.
    if (author == KernelAuthor::anybody) words.insert(words.end(), {"-fwrapv", "-fstack-clash-protection"});
    words.insert(words.end(), {"-isystem", include.string(), file.string(), "-o", library().string()});
    const candela::ProgramOutput compiled = candela::run_program(words);
    if (compiled.exit_code != 0) {
        const std::string errors = lines_of(
            compiled.err, [](const std::string& line) { return line.find("error") != std::string::npos; });
        throw KernelRefused(fmt::format("the kernel's text does not compile as C++ ({}):{}",
                                        compiler->string(),
                                        errors.empty() ? "\n" + compiled.err.substr(0, 400) : errors));
    }
    const auto warnings = [&](bool of_unused) {
        return lines_of(compiled.err, [&](const std::string& line) {
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

KernelProgram::Function KernelProgram::function(const std::string& name) const {
    const std::string symbol = "run_" + name;
    if (!library_.has(symbol)) FAIL("the kernel has no function for " << name);
    return &library_.get<std::remove_pointer_t<Function>>(symbol);
}

void KernelProgram::run(const std::string& call, const Values& values, int sample, const Arrays& in,
                        Arrays& out) const {
    const KernelInputs inputs = kernel_inputs(values);
    std::vector<const float*> tables, from;
    std::vector<int> sizes;
    for (const std::vector<float>& table : inputs.tables) {
        tables.push_back(table.data());
        sizes.push_back(static_cast<int>(table.size()));
    }
    std::vector<float*> to;
    for (std::size_t a = 0; a < in.arrays(); ++a) from.push_back(in[a]);
    for (std::size_t a = 0; a < out.arrays(); ++a) to.push_back(out[a]);
    function(call)(inputs.parameters.data(), tables.data(), sizes.data(), sample, in.count(), from.data(),
                   to.data());
}

candela::Vec3 KernelProgram::position(const Values& values, float u, float v) const {
    Arrays in(2, 1), out(3, 1);
    in[0][0] = u;
    in[1][0] = v;
    run("position", values, 0, in, out);
    return out.at(0, 0);
}
