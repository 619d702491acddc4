#include "cli/completion.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "cli/command_line.h"
#include "console/reporting.h"
#include "programs/bash_line.h"

import candela.api;
import candela.util;

namespace fs = std::filesystem;
namespace po = boost::program_options;
using candela::PluginKind;

namespace {

std::string_view shell_to_complete_for() {
    const char* const wanted = std::getenv("CANDELA_COMPLETE");
    return wanted != nullptr ? wanted : "";
}

/// The line, if the shell is bash.
std::optional<BashLine>& bash_line() {
    static std::optional<BashLine> line;
    return line;
}

}  // namespace

bool is_completing() { return !shell_to_complete_for().empty(); }

std::vector<std::string> words_to_complete(const std::vector<std::string>& arguments) {
    if (shell_to_complete_for() != "bash" || arguments.size() != 2) return arguments;
    bash_line().emplace(arguments[0], arguments[1]);
    const std::vector<std::string>& words = bash_line()->words();
    return {words.begin() + 1, words.end()};  // without the command
}

bool can_be_shown(std::string_view word) {
    return word.find('\t') == std::string_view::npos && candela::printable(word) == word;
}

void print_completions(std::string_view typed, std::span<const Completion> completions) {
    std::set<std::string_view> offered;
    std::vector<const Completion*> chosen;
    for (const Completion& completion : completions) {
        const std::string& word = completion.word;
        if (word.starts_with(typed) && can_be_shown(word) && offered.insert(word).second)
            chosen.push_back(&completion);
    }
    if (bash_line()) {
        for (const std::string& text : bash_line()->replacements_for({offered.begin(), offered.end()}))
            std::cout << text << '\n';
        return;
    }
    for (const Completion* const completion : chosen) {
        std::cout << completion->word;
        // One line: the rest of a meaning is detail.
        const std::string_view meaning = completion->meaning;
        if (!meaning.empty()) std::cout << '\t' << meaning.substr(0, meaning.find_first_of("\n\t"));
        std::cout << '\n';
    }
}

void print_file_completions(FileKind kind) {
    std::cout << (kind == FileKind::any ? "\tfiles\n" : "\tfolders\n");
}

namespace {

std::vector<Completion> plugins(candela::Registry& registry, PluginKind kind, std::string_view prefix = {}) {
    std::vector<Completion> result;
    for (const candela::PluginFile* const file : registry.list(kind))
        result.push_back({std::string(prefix) + file->manifest.name, file->manifest.summary});
    return result;
}

void append(std::vector<Completion>& to, std::vector<Completion> more) {
    to.insert(to.end(), more.begin(), more.end());
}

/// The kernel files of the current folder, which serve as models.
std::vector<Completion> kernel_files() {
    std::vector<Completion> result;
    std::error_code error;
    for (fs::directory_iterator entry(".", error), end; !error && entry != end; entry.increment(error)) {
        std::string name = entry->path().filename().string();
        if (candela::is_kernel_file(name))
            result.push_back({std::move(name), "a kernel file in this folder"});
    }
    std::ranges::sort(result, {}, &Completion::word);
    return result;
}

std::vector<Completion> models(candela::Registry& registry, PluginKind kind) {
    std::vector<Completion> result = plugins(registry, kind);
    append(result, kernel_files());
    return result;
}

/// Whether a path is being typed, not an id such as "reflection/ggx".
bool is_path(std::string_view typed) {
    const std::size_t slash = typed.find('/');
    return slash != std::string_view::npos &&
           std::ranges::none_of(candela::k_plugin_kinds, [&](PluginKind kind) {
               return candela::name_of(kind) == typed.substr(0, slash);
           });
}

std::vector<Completion> kinds() {
    std::vector<Completion> result;
    for (const PluginKind kind : candela::k_plugin_kinds)
        result.push_back({std::string(candela::name_of(kind))});
    return result;
}

std::vector<Completion> all_plugins(candela::Registry& registry) {
    std::vector<Completion> result;
    for (const PluginKind kind : candela::k_plugin_kinds)
        append(result, plugins(registry, kind, std::string(candela::name_of(kind)) + '/'));
    return result;
}

/// "ggx", and after its name "ggx:roughness=0.3,f0=": the arguments of `candela plot`.
std::vector<Completion> models_with_values(std::string_view typed, candela::Registry& registry) {
    const std::size_t colon = typed.find(':');
    if (colon == std::string_view::npos) {
        std::vector<Completion> result = models(registry, PluginKind::reflection);
        append(result, plugins(registry, PluginKind::reflection, "reflection/"));
        return result;
    }
    std::string_view name = typed.substr(0, colon);
    if (name.starts_with("reflection/")) name.remove_prefix(name.find('/') + 1);
    const candela::PluginFile* const file = registry.find(PluginKind::reflection, name);
    if (file == nullptr) return {};
    const std::string before(typed.substr(0, typed.find_last_of(":,") + 1));
    std::vector<Completion> result;
    for (const candela::Parameter& parameter : file->manifest.parameters)
        result.push_back({before + parameter.name + '=', parameter.meaning});
    return result;
}

std::vector<Completion> parameters_of(candela::Registry& registry, PluginKind kind) {
    std::vector<Completion> result;
    for (const candela::PluginFile* const file : registry.list(kind))
        for (const candela::Parameter& parameter : file->manifest.parameters)
            result.push_back({parameter.name, parameter.meaning});
    return result;
}

/// The options with known values.
struct OptionValues {
    std::string_view option;
    std::vector<Completion> (*values)(candela::Registry&);
};
constexpr OptionValues k_values_of_options[] = {
    {"shading", [](candela::Registry& r) { return models(r, PluginKind::shading); }},
    {"reflection", [](candela::Registry& r) { return models(r, PluginKind::reflection); }},
    {"target", [](candela::Registry& r) { return plugins(r, PluginKind::target); }},
    {"models",
     [](candela::Registry& r) {
         std::vector<Completion> result{{"all", "all that suit the scene"}};
         append(result, plugins(r, PluginKind::shading));
         append(result, models(r, PluginKind::reflection));
         return result;
     }},
    {"match", [](candela::Registry& r) { return parameters_of(r, PluginKind::reflection); }},
    {"format-set",
     [](candela::Registry& r) {
         std::vector<Completion> result = parameters_of(r, PluginKind::image);
         for (Completion& parameter : result) parameter.word += '=';
         return result;
     }},
    {"engine", [](candela::Registry&) { return std::vector<Completion>{{"local"}, {"slurm"}, {"print"}}; }},
    {"samples",
     [](candela::Registry& r) {
         std::vector<Completion> result = setting_completions("image.samples=", {}, r);
         for (Completion& value : result) value.word.erase(0, value.word.find('=') + 1);
         return result;
     }},
    {"format", [](candela::Registry&) { return std::vector<Completion>{{"json"}, {"markdown"}}; }}};

bool takes_value(const po::option_description& option) { return option.semantic()->max_tokens() > 0; }

/// Prints the completions that would not be taken for options.
void print_arguments(std::string_view typed, std::vector<Completion> completions) {
    std::erase_if(completions, [](const Completion& completion) { return completion.word.starts_with('-'); });
    print_completions(typed, completions);
}

/// The value's name in the help: "FILE".
std::string value_name_of(const po::option_description& option) {
    const std::string name = option.format_parameter();
    return name.substr(0, name.find(' '));
}

}  // namespace

void CommandLine::complete(const std::vector<std::string>& words) {
    be_quiet();
    const std::string typed = words.empty() ? std::string() : words.back();
    std::vector<std::string> before(words.begin(), words.empty() ? words.end() : words.end() - 1);
    const auto option_called = [&](const std::string& word) -> const po::option_description* {
        if (!word.starts_with('-')) return nullptr;
        for (const auto& option : visible_.options()) {
            if (word == "--" + option->long_name() ||
                word == option->canonical_display_name(po::command_line_style::allow_dash_for_short))
                return option.get();
        }
        return nullptr;
    };
    const po::option_description* option = before.empty() ? nullptr : option_called(before.back());
    if (option != nullptr && !takes_value(*option)) option = nullptr;
    if (option != nullptr) before.pop_back();  // its value is being typed
    try {
        read(before, Unknown::allowed);
    } catch (const po::error&) {
        values_.clear();  // unfinished or wrong: complete without the values
    }

    if (option != nullptr) return complete_value(*option, "", typed);
    const std::size_t equals = typed.find('=');
    if (typed.starts_with("--") && equals != std::string::npos) {
        option = option_called(typed.substr(0, equals));
        if (option != nullptr) complete_value(*option, typed.substr(0, equals + 1), typed.substr(equals + 1));
        return;
    }
    if (!typed.starts_with('-')) return complete_positional(typed);
    std::vector<Completion> options;
    for (const auto& each : visible_.options())
        options.push_back({"--" + each->long_name(), each->description()});
    print_completions(typed, options);
}

void CommandLine::complete_value(const po::option_description& option, const std::string& given,
                                 const std::string& typed) const {
    const std::string& name = option.long_name();
    const std::string value_name = value_name_of(option);
    if (value_name == "FILE") return print_file_completions(FileKind::any);
    if (value_name == "DIR" || value_name == "FOLDER") return print_file_completions(FileKind::folder);
    std::vector<Completion> values;
    std::string kept = given;
    candela::Registry registry = registry_from(*this);
    if (value_name.starts_with("PATH=")) {
        values = setting_completions(typed, scene_request_from(*this, registry), registry);
    } else if (const auto* const known = std::ranges::find(k_values_of_options, name, &OptionValues::option);
               known != std::end(k_values_of_options)) {
        if ((name == "reflection" || name == "shading") && is_path(typed))
            return print_file_completions(FileKind::any);
        values = known->values(registry);
        // Several verbs accept lists.
        kept += typed.substr(0, typed.rfind(',') + 1);
    }
    for (Completion& value : values) value.word.insert(0, kept);
    if (given.empty()) return print_arguments(typed, std::move(values));
    print_completions(given + typed, values);
}

void CommandLine::complete_positional(const std::string& typed) const {
    if (positional_.max_total_count() == 0) return;
    const std::string name = positional_.name_for_position(0);
    candela::Registry registry = registry_from(*this);
    if (name == "kind") return print_arguments(typed, kinds());
    if ((name == "plugin" || name == "model") && is_path(typed)) return print_file_completions(FileKind::any);
    if (name == "plugin") {
        std::vector<Completion> result = all_plugins(registry);
        append(result, kernel_files());
        return print_arguments(typed, std::move(result));
    }
    if (name == "model") return print_arguments(typed, models_with_values(typed, registry));
    if (name == "arguments" && all(name).empty()) return print_arguments(typed, kinds());  // plugin new
    print_file_completions(FileKind::any);
}
