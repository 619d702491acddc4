#include "kernel_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <string_view>
#include <system_error>

#include "helper.h"
#include "temporary_folder.h"

import candela.diagnostics;
import candela.files;
import candela.process;

namespace fs = std::filesystem;
using candela::Error;
using candela::ErrorCategory;
using candela::KernelFunction;
using candela::ParamSpec;
using candela::ParamType;
using candela::ParamValue;
using candela::PluginDescriptor;

namespace {

/// Statements that fill the kernel's struct, whose members are called as the parameters (see KernelText).
std::string parameters_of(const KernelCall& call, KernelNumbers& numbers) {
    std::string text;
    for (const std::size_t i : call.plugin->kernel.members) {
        const ParamSpec& parameter = call.plugin->parameters[i];
        const ParamValue& value = call.values[i];
        const auto column = [&](std::size_t c) {
            return numbers.text(candela::Vec3{value.number[c], value.number[c + 3], value.number[c + 6]});
        };
        switch (parameter.type) {
            case ParamType::real:
                text += fmt::format("m.{} = {}; ", parameter.name, numbers.text(value.number[0]));
                break;
            case ParamType::integer:
            case ParamType::boolean:
            case ParamType::choice:
                text += fmt::format("m.{} = {}; ", parameter.name, value.integer);
                break;
            case ParamType::matrix:
                text +=
                    fmt::format("m.{} = mat3({}, {}, {}); ", parameter.name, column(0), column(1), column(2));
                break;
            case ParamType::text:
            case ParamType::file:
            case ParamType::numbers: {
                if (value.list.empty()) break;
                std::string list;
                for (const float number : value.list) list += fmt::format("{:#.9g}f, ", number);
                text += fmt::format(
                    "static const float numbers_of_{0}[] = {{{1}}}; m.{0} = Table{{numbers_of_{0}, {2}}}; ",
                    parameter.name, list, value.list.size());
                break;
            }
            default:
                text += fmt::format(
                    "m.{} = {}; ", parameter.name,
                    numbers.text(candela::Vec3{value.number[0], value.number[1], value.number[2]}));
        }
    }
    return text;
}

std::optional<fs::path> compiler() {
    const char* const chosen = std::getenv("CXX");
    for (const std::string& name : {std::string(chosen == nullptr ? "" : chosen), std::string("clang++-19"),
                                    std::string("clang++"), std::string("g++"), std::string("c++")}) {
        if (name.empty()) continue;
        if (const auto found = candela::program_called(name)) return found;
    }
    return std::nullopt;
}

std::string text_of_file(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

void write_text(const fs::path& file, const std::string& text) {
    std::ofstream stream(file, std::ios::binary);
    stream << text;
    stream.close();
    if (!stream) throw Error(ErrorCategory::failure, fmt::format("cannot write '{}'", file.string()));
}

/// Of all headers, which the programs are compiled with. The modules, a folder beside them once installed,
/// are not.
std::size_t hash_of_headers(const fs::path& include) {
    std::vector<std::string> names =
        candela::names_in(include / "candela").value_or(std::vector<std::string>());
    std::ranges::sort(names);
    std::string all;
    for (const std::string& name : names) {
        const fs::path file = include / "candela" / name;
        std::error_code problem;
        if (fs::is_regular_file(file, problem)) all += name + text_of_file(file);
    }
    return std::hash<std::string>()(all);
}

/// The first line of the compiler's messages that says what is wrong.
std::string first_error(const std::string& messages) {
    std::istringstream lines(messages);
    lines.exceptions(std::ios::badbit);  // or std::getline() swallows std::bad_alloc, and the rest is lost
    for (std::string line; std::getline(lines, line);) {
        if (line.find("error:") != std::string::npos) return line;
    }
    return messages.substr(0, 200);
}

}  // namespace

std::string KernelNumbers::text(float number) {
    all_.push_back(number);
    return fmt::format("explained_numbers[{}]", all_.size() - 1);
}

std::string KernelNumbers::text(candela::Vec3 v) {
    const std::string x = text(v.x), y = text(v.y), z = text(v.z);
    return fmt::format("vec3({}, {}, {})", x, y, z);
}

bool KernelRun::has(const PluginDescriptor& plugin, const std::string& function) {
    return plugin.kernel.text != nullptr &&
           std::ranges::any_of(plugin.kernel.functions,
                               [&](const KernelFunction& each) { return each.name == function; });
}

std::string KernelRun::source(const std::vector<KernelCall>& calls, KernelNumbers& numbers) {
    std::string text = fmt::format("{}#include \"candela/kernel.h\"\nnamespace candela::kernel {{\n",
                                   kernel_trace_prelude());
    std::set<const PluginDescriptor*> written;
    for (const KernelCall& call : calls) {
        if (!has(*call.plugin, call.function) || !written.insert(call.plugin).second) continue;
        const std::string file = std::string(call.plugin->name) + ".kernel";
        text += fmt::format("#line 1 \"{}\"\n{}\n", file, kernels_.traced(call.plugin->kernel.text, file));
    }
    text += "}\nusing namespace candela::kernel;\n";
    std::string functions, main;
    for (std::size_t i = 0; i < calls.size(); ++i) {
        const KernelCall& call = calls[i];
        if (!has(*call.plugin, call.function)) continue;
        const candela::KernelText& kernel = call.plugin->kernel;
        const std::string name = fmt::format("{}_{}", kernel.prefix, call.function);
        std::string make = "0";
        if (*kernel.parameters != '\0') {
            make =
                fmt::format("[] {{ {} m; {}return {}; }}()", kernel.parameters, parameters_of(call, numbers),
                            has(*call.plugin, "prepare") ? fmt::format("{}_prepare(m)", kernel.prefix) : "m");
        }
        // A template, so that a call that does not fit is no error.
        functions += fmt::format(
            "template <class... A> void call_{0}(int sample, A... a) {{\n"
            "    const auto m = {2};\n"
            "    if constexpr (requires {{ {1}(m, a..., sample); }}) {1}(m, a..., sample);\n"
            "    else if constexpr (requires {{ {1}(m, a...); }}) {1}(m, a...);\n"
            "    else {1}(a...);\n}}\n",
            i, name, make);
        main += fmt::format("    std::printf(\"call {0}\\n\");\n    call_{0}({1}{2}{3});\n", i,
                            std::max(call.sample, 0), call.arguments.empty() ? "" : ", ", call.arguments);
    }
    const std::size_t count = std::max<std::size_t>(numbers.all().size(), 1);
    return text +
           fmt::format(
               "static float explained_numbers[{0}];\n{1}int main(int, char** words) {{\n"
               "    std::FILE* const file = std::fopen(words[1], \"rb\");\n"
               "    if (file == nullptr) return 1;\n"
               "    if (std::fread(explained_numbers, sizeof(float), {0}, file) != {0}) return 1;\n{2}}}\n",
               count, functions, main);
}

void KernelRun::read(const std::string& printed) {
    std::istringstream lines(printed);
    lines.exceptions(std::ios::badbit);  // or std::getline() swallows std::bad_alloc, and the rest is lost
    std::size_t call = 0;
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        words.exceptions(std::ios::badbit);  // likewise
        std::string kind;
        std::size_t number = 0;
        words >> kind >> number;
        if (kind == "call") {
            call = number;
            continue;
        }
        KernelValue value{.step = &kernels_.steps.at(number)};
        words >> value.depth >> value.member;
        if (value.member == ".") value.member.clear();
        if (kind == "note") --value.depth;
        for (std::string word; words >> word;) value.numbers.push_back(std::strtod(word.c_str(), nullptr));
        values_.at(call).push_back(std::move(value));
    }
}

bool KernelRun::compile(const fs::path& compiler, const fs::path& folder) {
    // Found before the one beside kernel.h, which is included as "candela/prelude.kernel".
    const candela::ProgramOutput compiled = candela::run_program(
        {compiler.string(), "-std=c++20", "-O0", "-w", "-fno-math-errno", "-ffp-contract=off", "-I",
         folder.string(), "-I", beside_command("include").string(), (folder / "kernels.cpp").string(), "-o",
         (folder / "kernels").string()});
    if (compiled.exit_code == 0) return true;
    why_not_ = fmt::format("the steps of the models' kernels are left out: {} does not compile them: {}",
                           compiler.filename().string(), first_error(compiled.err));
    return false;
}

KernelRun::KernelRun(const std::vector<KernelCall>& calls, KernelNumbers& numbers, const fs::path& kept)
    : values_(calls.size()) {
    const fs::path include = beside_command("include");
    std::error_code problem;
    if (!fs::exists(include / "candela/kernel.h", problem)) {
        why_not_ =
            "the steps of the models' kernels are left out: Candela's headers are not installed (package "
            "candela-dev)";
        return;
    }
    const std::string prelude =
        kernels_.traced(text_of_file(include / "candela/prelude.kernel"), "prelude.kernel");
    const std::string text =
        fmt::format("// with headers {:016x}\n", hash_of_headers(include)) + source(calls, numbers);
    const TemporaryFolder folder(kept.empty() ? fs::temp_directory_path() : kept, "candela-explain-");
    const fs::path made = folder.path() / "program";
    write_text(folder.path() / "numbers",
               numbers.all().empty() ? std::string(sizeof(float), '\0')
                                     : std::string(reinterpret_cast<const char*>(numbers.all().data()),
                                                   sizeof(float) * numbers.all().size()));
    const fs::path kept_program =
        kept.empty() ? fs::path() : kept / fmt::format("{:016x}", std::hash<std::string>()(prelude + text));
    const bool is_there = !kept.empty() && text_of_file(kept_program / "kernels.cpp") == text &&
                          text_of_file(kept_program / "candela/prelude.kernel") == prelude;
    if (!is_there) {
        const auto program = compiler();
        if (!program) {
            why_not_ = "the steps of the models' kernels are left out: there is no C++ compiler here";
            return;
        }
        fs::create_directories(made / "candela");
        write_text(made / "candela/prelude.kernel", prelude);
        write_text(made / "kernels.cpp", text);
        if (!compile(*program, made)) return;
        // Whole or not there; somebody else may have been faster.
        if (!kept.empty()) fs::rename(made, kept_program, problem);
    }
    const fs::path executable = (fs::exists(made / "kernels", problem) ? made : kept_program) / "kernels";
    const candela::ProgramOutput run =
        candela::run_program({executable.string(), (folder.path() / "numbers").string()});
    if (run.exit_code != 0) {
        why_not_ = "the steps of the models' kernels are left out: they cannot be run here";
        return;
    }
    read(run.out);
}
