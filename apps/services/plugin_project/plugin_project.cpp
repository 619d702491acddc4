#include "plugin_project/plugin_project.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <regex>
#include <string_view>

#include "programs/sibling_program.h"

import candela.api;
import candela.util;

namespace fs = std::filesystem;
using candela::Error;
using candela::ErrorCategory;
using candela::ExportedFile;

namespace {

std::string replaced(std::string text, const std::map<std::string, std::string>& values) {
    for (const auto& [from, to] : values) {
        for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
            text.replace(at, from.size(), to);
    }
    return text;
}

/// The type for "cook_torrance": CookTorrance.
std::string type_of(std::string_view words, char separator) {
    std::string type;
    bool begins_word = true;
    for (const char c : words) {
        if (c != separator)
            type += begins_word && c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
        begins_word = c == separator;
    }
    return type;
}

/// The kernel with its model's name replaced in all identifiers.
std::string renamed(const std::string& kernel, const candela::PluginDescriptor& plugin,
                    const ProjectNames& names) {
    const std::string prefix = plugin.kernel.prefix;
    const std::string text =
        std::regex_replace(kernel, std::regex(fmt::format(R"(\b{}_(?=\w))", prefix)), names.ident + "_");
    return std::regex_replace(text, std::regex(fmt::format(R"(\b{}(?=[A-Z]\w*\b))", type_of(prefix, '_'))),
                              names.type);
}

/// The kernel under its new title, with the model that it comes from instead of a summary.
std::string retitled(std::string kernel, const std::string& title, const std::string& summary) {
    const std::size_t begin = kernel.find("/// # ");
    if (begin == std::string::npos) return fmt::format("/// # {}\n/// {}\n///\n{}", title, summary, kernel);
    std::size_t end = begin;  // of the title and the paragraph behind it
    while (kernel.compare(end, 5, "/// \n") != 0 && kernel.compare(end, 4, "///\n") != 0 &&
           kernel.compare(end, 3, "///") == 0)
        end = kernel.find('\n', end) + 1;
    kernel.replace(begin, end - begin, fmt::format("/// # {}\n/// {}\n", title, summary));
    return kernel;
}

std::string test_of(const ProjectNames& names) {
    return fmt::format(
        "#include <candela/plugin_test.h>\n\n#include <catch2/catch_test_macros.hpp>\n#include <cmath>\n\n"
        "TEST_CASE(\"light from 60 degrees off the normal is reflected as finite, non-negative "
        "intensities\") {{\n"
        "    const auto parts = candela::sdk::reflected(CANDELA_PLUGIN_DIR, \"{}\", {{}}, 0, 60);\n"
        "    // Check the values that you expect, from your paper or worked out by hand.\n"
        "    for (const float part : {{parts.diffuse.x, parts.specular.x}}) {{\n"
        "        CHECK(std::isfinite(part));\n        CHECK(part >= 0);\n    }}\n}}\n",
        names.name);
}

}  // namespace

ProjectNames project_names(const std::string& name) {
    if (!candela::is_plugin_name(name)) {
        throw Error(ErrorCategory::bad_request,
                    fmt::format("'{}' is not a valid plugin name; expected lower-case letters, digits and "
                                "single hyphens, starting with a letter",
                                name));
    }
    ProjectNames names{.name = name, .ident = name, .type = type_of(name, '-'), .title = name};
    std::ranges::replace(names.ident, '-', '_');
    std::ranges::replace(names.title, '-', ' ');
    names.title.front() = static_cast<char>(names.title.front() - 'a' + 'A');
    return names;
}

std::vector<ExportedFile> template_files(const std::string& kind, const ProjectNames& names) {
    const std::map<std::string, std::string> values{
        {"@NAME@", names.name}, {"@IDENT@", names.ident}, {"@TYPE@", names.type}, {"@TITLE@", names.title}};
    const fs::path source = beside_command("share/candela/templates") / kind;
    if (!fs::is_directory(source))
        throw Error(ErrorCategory::failure,
                    fmt::format("the templates are not installed: '{}' does not exist (package candela-dev)",
                                source.string()));
    const auto templates = candela::names_in(source);
    if (!templates)
        throw Error(ErrorCategory::failure, fmt::format("the folder '{}' cannot be read", source.string()));
    std::vector<ExportedFile> files;
    for (const std::string& name : *templates) {
        const auto read = candela::read_text_file(source / name);
        if (!read)
            throw Error(ErrorCategory::failure, fmt::format("'{}' cannot be read", (source / name).string()));
        files.push_back({replaced(name, values), replaced(*read, values)});
    }
    return files;
}

std::vector<ExportedFile> files_like(const candela::PluginFile& model, const std::string& kernel,
                                     const ProjectNames& names) {
    const candela::PluginDescriptor& plugin = *model.descriptor;
    const std::string text = retitled(renamed(kernel, plugin, names), names.title,
                                      fmt::format("Based on {}: one sentence about it.", plugin.title));
    return {{names.name + ".kernel", text + (text.ends_with('\n') ? "" : "\n")},
            {names.name + "_test.cpp", test_of(names)}};
}
