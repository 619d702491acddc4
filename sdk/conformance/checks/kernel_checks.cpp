// Requirements for the text from which programs are generated: it is C++ and GLSL, and computes what the
// plugin computes.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>

#include "agreement.h"
#include "batch.h"
#include "candela/kernel_language/compiler.h"
#include "kernel_program.h"
#include "process/process.h"
#include "sandbox/temporary_folder.h"

import candela.api;
import candela.geometry;
import candela.util;

using candela::PluginKind;
using candela::Vec3;

namespace {

void skip_without_kernel() {
    if (subject().kernel.text == nullptr) SKIP("it has no kernel text: programs cannot be generated from it");
}

/// Makes "cook_torrance" and "CookTorrance" equal.
std::string lower_without_separators(const std::string& name) {
    std::string result;
    for (const char c : name) {
        if (c != '_') result += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    }
    return result;
}

void compare(const KernelProgram& program, const Call& call, const Values& values) {
    const bool is_light_sample = call.name.starts_with("illuminate (sample ");
    const int sample = is_light_sample ? std::stoi(call.name.substr(19)) : 0;
    const Arrays in = inputs_for(500);
    const Arrays expected = outputs_of(call, in);
    Arrays actual(expected.arrays(), in.count());
    program.run(is_light_sample ? "illuminate" : call.name, values, sample, in, actual);
    std::size_t differing = 0, first = in.count(), array = 0;
    for (std::size_t a = 0; a < expected.arrays(); ++a) {
        const std::size_t part = a - a % 3;
        for (std::size_t i = 0; i < in.count(); ++i) {
            const float largest = std::max({std::abs(expected[part][i]), std::abs(expected[part + 1][i]),
                                            std::abs(expected[part + 2][i])});
            if (agree(expected[a][i], actual[a][i], largest)) continue;
            if (differing++ == 0) {
                first = i;
                array = a;
            }
        }
    }
    if (static_cast<double>(differing) > k_may_differ * static_cast<double>(in.count()))
        FAIL("the kernel's text computes " << actual[array][first] << " as " << call.outputs[array / 3]
                                           << " where " << call.name << " returns " << expected[array][first]
                                           << ", for " << text_of_input(in, first) << ", with "
                                           << values.text);
}

void compare_shape(const KernelProgram& program, const Values& values) {
    const candela::Mesh mesh =
        candela::place(*make<candela::Shape>(values), {.uv = true, .derivatives = true}, {}).mesh;
    if (mesh.u.empty()) FAIL("it has kernel text, but its mesh has no texture coordinates to test it at");
    float size = 0;
    for (std::size_t i = 0; i < mesh.vertex_count(); ++i)
        size = std::max(size, candela::length(mesh.position.span()[i]));
    const std::size_t step = std::max<std::size_t>(mesh.vertex_count() / 500, 1);
    for (std::size_t i = 0; i < mesh.vertex_count(); i += step) {
        const Vec3 expected = mesh.position.span()[i];
        const Vec3 actual = program.position(values, mesh.u[i], mesh.v[i]);
        if (candela::length(actual - expected) > 1e-4f * size)
            FAIL(
                fmt::format("the kernel's text puts ({}, {}) at [{}, {}, {}], but the mesh has [{}, {}, {}] "
                            "there, with {}",
                            mesh.u[i], mesh.v[i], actual.x, actual.y, actual.z, expected.x, expected.y,
                            expected.z, values.text));
    }
}

}  // namespace

TEST_CASE(
    "kernel names: everything that it declares begins with its own name, since one program may contain "
    "several kernels",
    "[reflection][light][shading][shape]") {
    skip_without_kernel();
    const candela::KernelText& kernel = subject().kernel;
    const std::string prefix = lower_without_separators(kernel.prefix);
    static const std::regex k_declared(
        R"(^(?:struct\s+(\w+)|#\s*define\s+(\w+)|(?:KERNEL|const|constexpr|inline|static)\s[\w\s]*?\b(\w+)\s*[({=\[]))");
    std::istringstream lines(kernel.text);
    lines.exceptions(std::ios::badbit);  // otherwise std::getline() swallows std::bad_alloc, and the rest is
                                         // lost
    int number = 0;
    for (std::string line; std::getline(lines, line);) {
        ++number;
        std::smatch found;
        if (!std::regex_search(line, found, k_declared)) continue;
        const std::string name = found[1].matched ? found[1] : found[2].matched ? found[2] : found[3];
        if (lower_without_separators(name).starts_with(prefix)) continue;
        FAIL_CHECK(kernel_file_name()
                   << ":" << number << ": '" << name << "' may be declared by another kernel of "
                   << "the same program; call it " << kernel.prefix << "_" << name << ", for example");
    }
}

TEST_CASE("kernel as C++: the text compiles, and computes the same numbers as the plugin",
          "[reflection][light][shading][shape]") {
    skip_without_kernel();
    const KernelProgram program;
    if (!program.compiled().unused().empty())
        WARN("the kernel has variables that are never read:" << program.compiled().unused());
    if (!program.compiled().warnings().empty())
        FAIL_CHECK("programs generated from the kernel's text compile with warnings:"
                   << program.compiled().warnings());
    for (const Values& values : many_values(20)) {
        if (subject_manifest().kind == PluginKind::shape) {
            compare_shape(program, values);
            continue;
        }
        int calls = 0;
        for (const Call& call : batch_subject(values).calls) {
            // The visible surroundings, and the effect of many lights, are computed from several functions,
            // and a large source by its samples.
            if (call.name == "show_environment" || call.name == "reflect_all_lights" || ++calls > 4) continue;
            compare(program, call, values);
        }
    }
}

TEST_CASE("kernel as GLSL: the text compiles as GLSL 3.30 and as GLSL ES 3.00",
          "[reflection][light][shading][shape]") {
    skip_without_kernel();
    const auto validator = candela::program_called("glslangValidator");
    if (!validator) SKIP("glslangValidator is not installed");
    const std::filesystem::path include = candela::kernel_language::kernel_headers();
    if (include.empty()) SKIP("Candela's headers are not installed with the kit");
    std::string prelude;
    for (const char* const part : {"candela/kernel/table.glsl", "candela/kernel/prelude.kernel"}) {
        std::ifstream file(include / part);
        prelude.append(std::istreambuf_iterator<char>(file), {});
    }
    const TemporaryFolder folder("candela-kernel-");
    const std::filesystem::path shader = folder.path() / "shader.frag";
    for (const std::string version : {"330 core", "300 es"}) {
        std::ofstream(shader) << "#version " << version << "\n"
                              << (version == "300 es" ? "precision highp float;\nprecision highp int;\n" : "")
                              << "#define KERNEL\nout vec4 color;\n"
                              << prelude << "\n#line 1\n"
                              << subject().kernel.text << "\nvoid main() { color = vec4(1.0); }\n";
        const candela::ProgramOutput compiled = candela::run_program({validator->string(), shader.string()});
        if (compiled.exit_code == 0) continue;
        // "ERROR: 0:12: …", after a line with the file's name: "#line" has set the number.
        static const std::regex k_error("ERROR: \\d+:(\\d+):");
        std::istringstream lines(compiled.out);
        lines.exceptions(
            std::ios::badbit);  // otherwise std::getline() swallows std::bad_alloc, and the rest is lost
        std::string errors;
        for (std::string line; std::getline(lines, line) && errors.size() < 400;) {
            if (std::regex_search(line, k_error))
                errors += "\n" + std::regex_replace(line, k_error, kernel_file_name() + ":$1:");
        }
        FAIL("the kernel's text does not compile as GLSL "
             << version << ":" << (errors.empty() ? "\n" + compiled.out.substr(0, 400) : errors));
    }
}
