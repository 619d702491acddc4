#include "candela/kernel_language/model_compiler.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <functional>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <variant>
#include <vector>

#include "candela/kernel_language/compiler.h"
#include "candela/kernel_language/kernel_cache.h"
#include "candela/kernel_language/language.h"
#include "candela/kernel_language/lexer.h"
#include "candela/kernel_language/model.h"
#include "process/process.h"
#include "sandbox/temporary_folder.h"

import candela.api;
import candela.plugins;
import candela.util;

namespace fs = std::filesystem;

namespace candela::kernel_language {

namespace {

std::vector<std::string> options() {
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
            "-DCANDELA_PLUGIN_VERSION=\"0\""};
}

/// The characters of the word, number or sign at a line and column; 0 if there is none.
int length_at(std::string_view text, std::size_t line, std::size_t column) {
    for (; line > 1 && text.find('\n') != std::string_view::npos; --line)
        text.remove_prefix(text.find('\n') + 1);
    text = text.substr(0, text.find('\n'));
    for (; column > 1 && !text.empty(); --column) text.remove_prefix(first_character(text).size());
    const std::vector<Lexeme> code = code_of(text);
    return code.empty() || code.front().offset > 0 ? 0 : static_cast<int>(character_count(code.front().text));
}

[[noreturn]] void refuse(const Problem& problem, const std::string& text) {
    const std::string whole = problem.what();
    const std::size_t end = std::min(whole.find("; did you mean "), whole.size());
    throw KernelError({problem.file(), static_cast<int>(problem.line()), static_cast<int>(problem.column()),
                       length_at(text, problem.line(), problem.column())},
                      whole.substr(0, end), whole.substr(std::min(end + 2, whole.size())), text);
}

/// The kernel, with the function that only a model which reflects ambient light needs to have.
std::string completed(const Kernel& kernel, const std::string& prefix) {
    const std::string& text = kernel.sources.front().text;
    std::string material;
    bool reflects = false;
    for (const Declaration& declaration : kernel.declarations) {
        const auto* const function = std::get_if<Function>(&declaration);
        if (function == nullptr) continue;
        if (function->name == prefix + "_reflect_ambient") return text;
        if (function->name != prefix + "_reflect" || function->parameters.empty()) continue;
        reflects = true;
        const Variable& first = function->parameters.front();
        if (first.type.name != "Surface") material = fmt::format("{} {}, ", first.type.name, first.name);
    }
    if (!reflects) return text;
    return fmt::format("{}{}\nKERNEL vec3 {}_reflect_ambient({}Surface s) {{\n    return vec3(0.0f);\n}}\n",
                       text, text.ends_with('\n') ? "" : "\n", prefix, material);
}

/// A text in its language, and what it declares.
struct CheckedModel {
    std::string text;
    std::string code;  // C++
    ModelDeclaration model;
};

CheckedModel check(const Source& kernel, std::string_view name) {
    try {
        std::string prefix(name);
        std::ranges::replace(prefix, '-', '_');
        Kernel whole = read_kernel(kernel);
        const std::string text = completed(whole, prefix);
        if (text != kernel.text) whole = read_kernel({kernel.name, text});
        ModelDeclaration model = read_model(whole, name);
        // The same text is compiled once, wherever its file is.
        whole.sources.front().name = fmt::format("{}.kernel", name);
        return {text, emitted(whole, Emission::guarded_cpp), std::move(model)};
    } catch (const Problem& problem) {
        refuse(problem, kernel.text);
    }
}

/// Replaces the temporary folder, which users do not know, in a compiler's message.
std::string without(const fs::path& folder, std::string message) {
    const std::string path = folder.string() + "/";
    for (std::size_t at = message.find(path); at != std::string::npos; at = message.find(path, at))
        message.erase(at, path.size());
    return message;
}

/// Compiles a model to a plugin in `folder`.
void build(const CheckedModel& checked, const fs::path& compiler, const fs::path& headers,
           const fs::path& folder, const std::string& library) {
    const std::string& name = checked.model.name;
    write_text_file(folder / (name + ".kernel"), checked.text);
    write_text_file(folder / (name + ".inc"), checked.code);
    write_text_file(folder / (name + ".cpp"),
                    plugin_source(checked.model, (folder / (name + ".inc")).string()));
    write_text_file(folder / "plugin.map", "{ global: candela_*; local: *; };\n");
    std::vector<std::string> words = options();
    words.insert(words.end(),
                 {fmt::format("-DCANDELA_PLUGIN_NAME=\"{}\"", name),
                  fmt::format("-DCANDELA_KERNEL_FILE=\"{}\"", (folder / (name + ".kernel")).string()), "-I",
                  headers.string(), "-Wl,--version-script=" + (folder / "plugin.map").string()});
    const fs::path core = plugin_search_path({}).back().parent_path().parent_path() / CANDELA_CORE_FILE;
    const fs::path output = folder / (library + ".so");
    const CompilerReport report = compile(compiler, {.options = std::move(words),
                                                     .inputs = {folder / (name + ".cpp"), core},
                                                     .output = output,
                                                     .temporary = folder});
    if (!report.is_success) {
        const std::string log = without(folder, first_error(report.log));
        throw Error(ErrorCategory::failure,
                    fmt::format("{} could not compile the kernel: {}", compiler.string(),
                                log.empty() ? "it gave no reason" : log));
    }
    write_text_file(folder / (library + ".json"),
                    to_json(manifest_of(load_plugin(output, nullptr), host_abi())));
    for (const char* const extension : {".inc", ".cpp"}) fs::remove(folder / (name + extension));
    fs::remove(folder / "plugin.map");
}

/// Keeps a model's plugin, made by `make` in a folder of its own.
void fill(const fs::path& cache, const fs::path& folder, const std::function<void(const fs::path&)>& make) {
    const auto refuse_folder = [&](const std::error_code& problem) {
        throw Error(
            ErrorCategory::failure,
            fmt::format("compiled kernels cannot be kept in '{}': {} (XDG_CACHE_HOME names another folder)",
                        cache.string(), problem.message()));
    };
    std::optional<TemporaryFolder> temporary;
    try {
        fs::create_directories(cache);
        temporary.emplace("new-", cache);
    } catch (const std::system_error& problem) {
        refuse_folder(problem.code());
    }
    const fs::path made = temporary->path() / "plugin";
    fs::create_directory(made);
    make(made);
    if (const std::error_code problem = keep(made, folder)) refuse_folder(problem);
    remove_unused(cache);
}

}  // namespace

CompiledKernel compile_model(const Source& kernel, std::string_view name, const fs::path& cache) {
    const CheckedModel checked = check(kernel, name);
    const std::string library = fmt::format("{}-{}", name_of(checked.model.kind), checked.model.name);
    const auto compiler = cxx_compiler();
    if (!compiler)
        throw Error(ErrorCategory::failure,
                    "a kernel needs a C++ compiler, and none is installed (packages g++ or clang)");
    const fs::path headers = kernel_headers();
    if (headers.empty())
        throw Error(ErrorCategory::failure,
                    "a kernel needs Candela's headers, which are not installed (package candela-dev)");
    ContentHash hash;
    hash.add(checked.text)
        .add(checked.code)
        .add(plugin_source(checked.model, ""))
        .add(host_abi())
        .add(compiler->string())
        .add_headers(headers);
    for (const std::string& option : options()) hash.add(option);
    const fs::path folder = cache / hash.text();
    const CompiledKernel compiled{checked.model.kind, checked.model.name, folder};
    const bool is_there =
        is_kept(folder) && read_text_file(folder / (checked.model.name + ".kernel")) == checked.text;
    if (!is_there)
        fill(cache, folder, [&](const fs::path& made) { build(checked, *compiler, headers, made, library); });
    return compiled;
}

CompiledKernel compile_kernel_file(const fs::path& file) {
    std::string name;
    try {
        name = model_name(file);
    } catch (const std::invalid_argument& problem) {
        throw Error(ErrorCategory::bad_request, problem.what());
    }
    std::error_code problem;
    const fs::file_status status = fs::status(file, problem);
    const auto fail = [&](const std::string& why) {
        throw Error(ErrorCategory::failure, fmt::format("'{}' {}", file.string(), why));
    };
    if (status.type() == fs::file_type::not_found) fail("does not exist");
    if (status.type() == fs::file_type::directory) fail("is a directory, not a file");
    if (fs::exists(status) && !fs::is_regular_file(status)) fail("is not a regular file");
    const auto text = read_text_file(file, k_longest_text + 1);
    if (!text) fail(fmt::format("cannot be read: {}", std::strerror(errno)));
    return compile_model({file.string(), *text}, name, kernel_cache());
}

}  // namespace candela::kernel_language
