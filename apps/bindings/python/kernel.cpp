// Compiles plugins at run time.
#include "binding.h"

#include <map>
#include <set>
#include <tuple>
#include <utility>
#include <variant>

#include "candela/kernel_language/compiler.h"
#include "candela/kernel_language/language.h"
#include "module.h"

import candela.plugins;
import candela.util;

namespace candela::python {

namespace {

namespace fs = std::filesystem;

std::vector<std::string> options_for(const std::string& name, const fs::path& folder) {
    return {"-O3",
            "-fPIC",
            "-shared",
            "-fvisibility=hidden",
            "-fno-math-errno",
            "-fno-trapping-math",
            "-fwrapv",  // defines integer overflow in kernels
            "-fstack-clash-protection",
#ifdef __x86_64__
            "-mprefer-vector-width=512",
#endif
            "-w",
            fmt::format("-DCANDELA_PLUGIN_NAME=\"{}\"", name),
            "-DCANDELA_PLUGIN_VERSION=\"0\"",
            fmt::format("-DCANDELA_KERNEL_FILE=\"{}\"", (folder / (name + ".kernel")).string()),
            "-I",
            kernel_language::kernel_headers().string(),
            "-I",
            folder.string(),
            "-Wl,--version-script=" + (folder / "plugin.map").string()};
}

/// Removes the temporary folder, which users do not know, from a compiler's message.
std::string without(const fs::path& folder, std::string message) {
    const std::string path = folder.string() + "/";
    for (std::size_t at = message.find(path); at != std::string::npos; at = message.find(path, at))
        message.erase(at, path.size());
    return message;
}

/// Compiles <folder>/<name>.cpp to a plugin in that folder, with the exports in <folder>/plugin.map, and
/// writes its manifest.
void compile_plugin(const std::string& name, const fs::path& folder) {
    const auto compiler = cxx_compiler();
    if (!compiler)
        throw Error(ErrorCategory::failure,
                    "a kernel needs a C++ compiler, and none is installed (packages g++ or clang)");
    if (kernel_language::kernel_headers().empty())
        throw Error(ErrorCategory::failure,
                    "a kernel needs Candela's headers, which are not installed (package candela-dev)");
    const fs::path library = folder / fmt::format("reflection-{}.so", name);
    const fs::path core = plugin_search_path({}).back().parent_path().parent_path() / CANDELA_CORE_FILE;
    const kernel_language::CompilerReport report =
        kernel_language::compile(*compiler, {.options = options_for(name, folder),
                                             .inputs = {folder / (name + ".cpp"), core},
                                             .output = library,
                                             .temporary = folder});
    if (!report.is_success) {
        throw Error(ErrorCategory::bad_request,
                    fmt::format("{} could not compile the kernel: {}", compiler->filename().string(),
                                without(folder, kernel_language::first_error(report.log))));
    }
    const Manifest manifest = manifest_of(load_plugin(library, nullptr), host_abi());
    OutputFile file(fs::path(library).replace_extension(".json"), Existing::replaced);
    file.write(to_json(manifest));
    file.finish();
}

/// Throws Error if the text is not in the kernel language.
kernel_language::Kernel kernel_from(const std::string& source, const std::string& file) {
    try {
        return kernel_language::read_kernel({file, source});
    } catch (const kernel_language::Problem& problem) {
        throw Error(ErrorCategory::bad_request, problem.text());
    }
}

std::string kernel_as_cpp(const std::string& source, const std::string& file) {
    return kernel_language::emitted(kernel_from(source, file), kernel_language::Emission::guarded_cpp);
}

void add_members_read(const std::vector<kernel_language::Expression>& expressions,
                      std::set<std::string>& names) {
    for (const kernel_language::Expression& expression : expressions) {
        if (expression.kind == kernel_language::Expression::Kind::member) names.insert(expression.text);
        add_members_read(expression.operands, names);
    }
}

void add_members_read(const std::vector<kernel_language::Statement>& statements,
                      std::set<std::string>& names) {
    for (const kernel_language::Statement& statement : statements) {
        add_members_read(statement.expressions, names);
        add_members_read(statement.statements, names);
    }
}

/// The declarations of a kernel: its structs' members, its functions with the types of their parameters, and
/// the names of the members that they read.
struct KernelDeclarations {
    std::map<std::string, std::vector<std::pair<std::string, std::string>>> structs;
    std::vector<std::tuple<std::string, std::string, std::vector<std::string>>> functions;
    std::set<std::string> members_read;
};

KernelDeclarations kernel_declarations(const std::string& source, const std::string& file) {
    KernelDeclarations all;
    for (const kernel_language::Declaration& declaration : kernel_from(source, file).declarations) {
        if (const auto* const structure = std::get_if<kernel_language::Structure>(&declaration)) {
            auto& members = all.structs[structure->name];
            for (const auto& member : structure->members) members.emplace_back(member.type.name, member.name);
        } else if (const auto* const function = std::get_if<kernel_language::Function>(&declaration)) {
            std::vector<std::string> types;
            for (const auto& parameter : function->parameters) types.push_back(parameter.type.name);
            all.functions.emplace_back(function->result.name, function->name, std::move(types));
            add_members_read(function->body, all.members_read);
        }
    }
    return all;
}

}  // namespace

void add_kernel(py::module_& module) {
    module.def("compile_plugin", &compile_plugin, py::arg("name"), py::arg("folder"),
               py::call_guard<py::gil_scoped_release>(), "Makes a plugin from the files in a folder.");
    module.def("kernel_as_cpp", &kernel_as_cpp, py::arg("source"), py::arg("file"),
               "Translates a kernel, which must be in the kernel language, to C++.");
    py::class_<KernelDeclarations>(module, "KernelDeclarations", "The declarations of a kernel.")
        .def_readonly("structs", &KernelDeclarations::structs)
        .def_readonly("functions", &KernelDeclarations::functions)
        .def_readonly("members_read", &KernelDeclarations::members_read);
    module.def("kernel_declarations", &kernel_declarations, py::arg("source"), py::arg("file"),
               "Reads what a kernel, which must be in the kernel language, declares.");
}

}  // namespace candela::python
