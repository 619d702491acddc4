#include "exercise/exercises.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <system_error>

#include "candela/kernel_language/lexer.h"
#include "json/json.h"

import candela.api;
import candela.util;

namespace fs = std::filesystem;
namespace kl = candela::kernel_language;
using candela::Error;
using candela::ErrorCategory;

namespace {

constexpr int k_version = 1;
constexpr std::size_t k_largest_file = 100'000;  // bytes
constexpr std::size_t k_most_files = 10'000;

/// The names of the functions defined by a kernel.
std::vector<std::string> functions_of(const std::string& text) {
    const std::vector<kl::Lexeme> code = kl::code_of(text);
    std::vector<std::string> names;
    for (std::size_t i = 0; i < code.size(); ++i) {
        if (code[i].text == "KERNEL" && kl::text_at(code, i + 3) == "(") names.emplace_back(code[i + 2].text);
    }
    return names;
}

/// The index of the brace that opens a function's body; the code's size if the function is not defined.
std::size_t opening_brace_of(std::string_view function, const std::vector<kl::Lexeme>& code) {
    for (std::size_t i = 0; i < code.size(); ++i) {
        if (code[i].text != "KERNEL" || kl::text_at(code, i + 2) != function ||
            kl::text_at(code, i + 3) != "(")
            continue;
        while (i < code.size() && code[i].text != ")") ++i;
        if (kl::text_at(code, i + 1) == "{") return i + 1;
    }
    return code.size();
}

Error no_answer(const fs::path& file, const std::string& why) {
    return {ErrorCategory::bad_request,
            fmt::format("'{}' is not an answer to an exercise: {}", file.string(), why)};
}

}  // namespace

const candela::PluginFile& loaded_model(candela::PluginKind kind, const std::string& model,
                                        candela::Registry& registry) {
    const std::size_t slash = candela::is_kernel_file(model) ? std::string::npos : model.find('/');
    const std::string name = slash == std::string::npos ? model : model.substr(slash + 1);
    if (slash != std::string::npos && model.substr(0, slash) != candela::name_of(kind)) {
        throw Error(ErrorCategory::bad_request,
                    fmt::format("'{}' is not a {} model", model, candela::name_of(kind)));
    }
    const candela::PluginFile& file = registry.require(kind, name);
    for (const candela::Parameter& parameter : file.manifest.parameters) {
        if (parameter.type == candela::ParamType::file && !parameter.default_value)
            throw Error(ErrorCategory::bad_request,
                        fmt::format("{} needs a file ({}), which its kernel alone cannot read",
                                    file.manifest.id(), parameter.name));
    }
    if (registry.descriptor(kind, name).kernel.text == nullptr)
        throw Error(ErrorCategory::bad_request, fmt::format("{} has no kernel text", file.manifest.id()));
    return file;
}

TextAroundBody text_around_body(const std::string& text, const std::string& function) {
    const std::vector<kl::Lexeme> code = kl::code_of(text);
    const std::size_t open = opening_brace_of(function, code);
    if (open == code.size())
        throw Error(ErrorCategory::bad_request,
                    fmt::format("the kernel declares {}() in a way that exercises do not support", function));
    std::size_t close = open + 1;
    for (std::size_t depth = 1; close < code.size(); ++close) {
        if (code[close].text == "{") ++depth;
        if (code[close].text == "}" && --depth == 0) break;
    }
    return {.before = text.substr(0, code[open].end()),
            .after = close < code.size() ? text.substr(code[close].offset) : ""};
}

Exercise exercise_about(const std::string& model, const std::string& function, candela::Registry& registry) {
    const candela::PluginFile& file = loaded_model(candela::PluginKind::reflection, model, registry);
    const std::string text = kl::without_comments(file.descriptor->kernel.text);
    const std::string prefix = std::string(file.descriptor->kernel.prefix) + "_";
    // The compiled kernel has an ambient part even if its file has none.
    const auto written =
        candela::is_kernel_file(model) ? candela::read_text_file(model, kl::k_longest_text) : std::nullopt;
    const std::vector<std::string> names = functions_of(written.value_or(text));
    const auto is_defined = [&](const std::string& name) {
        return std::ranges::find(names, name) != names.end();
    };
    const std::string name = is_defined(function) ? function : prefix + function;
    if (!is_defined(name)) {
        std::vector<std::string> short_names;
        for (const std::string& each : names)
            short_names.push_back(each.starts_with(prefix) ? each.substr(prefix.size()) : each);
        if (function.empty())
            throw Error(
                ErrorCategory::bad_request,
                fmt::format("--blank is missing: the function of reflection/{} to leave blank (possible: {})",
                            file.manifest.name, fmt::join(short_names, ", ")));
        std::vector<std::string> possible = short_names;
        possible.insert(possible.end(), names.begin(), names.end());
        const std::string meant = candela::suggestion(function, possible);
        throw Error(ErrorCategory::bad_request,
                    fmt::format("the kernel of reflection/{} has no function '{}'{} (possible: {})",
                                file.manifest.name, function, meant.empty() ? "" : "; " + meant,
                                fmt::join(short_names, ", ")));
    }
    kl::Source kernel{.name = file.manifest.name + ".kernel", .text = file.descriptor->kernel.text};
    try {
        static_cast<void>(kl::read_kernel(kernel));
    } catch (const kl::Problem& problem) {
        throw Error(ErrorCategory::bad_request,
                    fmt::format("the kernel of reflection/{} is not in the kernel language: {}",
                                file.manifest.name, problem.text()));
    }
    return {.model = candela::is_kernel_file(model) ? model : "reflection/" + file.manifest.name,
            .function = name,
            .plugin = &file,
            .text = text_around_body(text, name),
            .kernel = std::move(kernel)};
}

Answer answer_from(const fs::path& file) {
    const std::optional<std::string> text = candela::read_text_file(file, k_largest_file);
    if (!text) throw Error(ErrorCategory::failure, fmt::format("'{}' cannot be read", file.string()));
    if (text->size() > k_largest_file)
        throw no_answer(file, fmt::format("it is larger than {} bytes", k_largest_file));
    const Json json = json_or_discarded(*text);
    if (!json.is_object())
        throw no_answer(file, "it is not a JSON object; expected a file saved by the exercise's page");
    const auto text_of = [&](const char* key) {
        if (!json.contains(key) || !json[key].is_string())
            throw no_answer(file, fmt::format("'{}' is missing; expected a string", key));
        return json[key].get<std::string>();
    };
    if (!json.contains("candela_exercise") || json["candela_exercise"] != k_version)
        throw no_answer(file, fmt::format("'candela_exercise' is missing or not {}", k_version));
    Answer answer{.file = file, .model = text_of("model"), .function = text_of("function"), .body = {}};
    if (!json.contains("answer") || !json["answer"].is_array())
        throw no_answer(file, "'answer' is missing; expected an array of lines");
    for (const Json& line : json["answer"]) {
        if (!line.is_string() || line.get_ref<const std::string&>().find('\n') != std::string::npos)
            throw no_answer(file, "'answer' contains something that is not a line of text");
        answer.body += (answer.body.empty() ? "" : "\n") + line.get<std::string>();
    }
    return answer;
}

std::vector<fs::path> answers_in(const std::vector<std::string>& files_and_folders) {
    std::vector<fs::path> files;
    for (const std::string& named : files_and_folders) {
        std::error_code problem;
        if (!fs::is_directory(named, problem)) {
            if (!fs::is_regular_file(named, problem))
                throw Error(ErrorCategory::failure, fmt::format("there is no file or folder '{}'", named));
            files.emplace_back(named);
            continue;
        }
        auto names = candela::names_in(named, k_most_files);
        if (!names) throw Error(ErrorCategory::failure, fmt::format("the folder '{}' cannot be read", named));
        std::ranges::sort(*names);
        const std::size_t before = files.size();
        for (const std::string& name : *names)
            if (name.ends_with(".answer")) files.push_back(fs::path(named) / name);
        if (files.size() == before)
            throw Error(ErrorCategory::failure,
                        fmt::format("there are no answers (*.answer) in '{}'", named));
    }
    return files;
}
