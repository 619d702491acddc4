#include "plugin_project/plugin_project.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <string_view>
#include <utility>
#include <variant>

#include "candela/kernel_language/language.h"
#include "programs/sibling_program.h"

import candela.api;
import candela.util;

namespace fs = std::filesystem;
namespace kl = candela::kernel_language;
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

std::string name_of(const kl::Declaration& declaration) {
    if (const auto* const structure = std::get_if<kl::Structure>(&declaration)) return structure->name;
    if (const auto* const function = std::get_if<kl::Function>(&declaration)) return function->name;
    return std::get<kl::Constant>(declaration).declaration.name;
}

/// The names that the kernel declares and that begin with its model's, with the new one's instead.
std::map<std::string, std::string, std::less<>> new_names(const std::string& kernel,
                                                          const candela::PluginDescriptor& plugin,
                                                          const ProjectNames& names) {
    const std::string prefix = plugin.kernel.prefix;
    const std::string type = type_of(prefix, '_');
    std::map<std::string, std::string, std::less<>> renamed;
    try {
        for (const kl::Declaration& declaration :
             kl::read_kernel({prefix + ".kernel", kernel}).declarations) {
            const std::string name = name_of(declaration);
            if (name.starts_with(prefix + "_"))
                renamed[name] = names.ident + name.substr(prefix.size());
            else if (name.starts_with(type))
                renamed[name] = names.type + name.substr(type.size());
        }
    } catch (const kl::Problem& problem) {
        throw Error(ErrorCategory::bad_request, problem.text());
    }
    return renamed;
}

/// The kernel with its model's name replaced in all identifiers, in comments too.
std::string renamed(const std::string& kernel, const candela::PluginDescriptor& plugin,
                    const ProjectNames& names) {
    const auto replacements = new_names(kernel, plugin, names);
    const auto is_part = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
    };
    std::string text;
    for (auto at = kernel.begin(); at != kernel.end();) {
        const auto end = is_part(*at) ? std::find_if_not(at, kernel.end(), is_part) : at + 1;
        const std::string_view word(at, end);
        const auto found = replacements.find(word);
        text += found != replacements.end() ? found->second : word;
        at = end;
    }
    return text;
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

/// A value in C++ that the parameter may have.
std::string some_value(const candela::Parameter& p) {
    using Type = candela::ParamType;
    const float low = std::isfinite(p.minimum) ? p.minimum : std::isfinite(p.maximum) ? p.maximum - 2 : 0;
    const float high = std::isfinite(p.maximum) ? p.maximum : low + 2;
    const double middle = candela::shortest(low + (high - low) / 2);
    const auto number = [&] { return candela::toml_text(middle, Type::real); };
    switch (p.type) {
        case Type::real:
            return number();
        case Type::integer:
            return p.choices.empty() ? fmt::format("std::int64_t{{{:.0f}}}", std::floor(middle))
                                     : p.choices.front();
        case Type::boolean:
            return "true";
        case Type::choice:
            return fmt::format("std::string(\"{}\")", p.choices.front());
        case Type::text:
        case Type::file:
            return "std::string()";
        case Type::color:
            return "candela::Vec3{255, 255, 255}";
        case Type::matrix:
            return "candela::Matrix{1, 0, 0, 0, 1, 0, 0, 0, 1}";
        case Type::numbers:
            return fmt::format("candela::NumberList{{{}f}}", number());
        default:
            return fmt::format("candela::Vec3{{{0}f, {0}f, {0}f}}", number());
    }
}

/// Values for the parameters that have no default: {{"position", candela::Vec3{1, 1, 1}}}.
std::string required_values(const std::vector<candela::Parameter>& parameters) {
    std::vector<std::string> values;
    for (const candela::Parameter& each : parameters)
        if (!each.default_value) values.push_back(fmt::format("{{\"{}\", {}}}", each.name, some_value(each)));
    return fmt::format("{{{}}}", fmt::join(values, ", "));
}

std::string test_of(const candela::Manifest& model, const ProjectNames& names) {
    if (model.kind != candela::PluginKind::reflection)
        return fmt::format(
            "#include <candela/plugin_test.h>\n\n#include <catch2/catch_test_macros.hpp>\n\n"
            "TEST_CASE(\"it accepts these values\") {{\n"
            "    const auto model = candela::sdk::make<candela::{}>(CANDELA_PLUGIN_DIR, \"{}\", {});\n"
            "    // Check the values that you expect, from your paper or worked out by hand.\n"
            "    CHECK(model != nullptr);\n}}\n",
            model.kind == candela::PluginKind::light ? "Light" : "ShadingModel", names.name,
            required_values(model.parameters));
    return fmt::format(
        "#include <candela/plugin_test.h>\n\n#include <catch2/catch_test_macros.hpp>\n#include <cmath>\n\n"
        "TEST_CASE(\"light from 60 degrees off the normal is reflected as finite, non-negative "
        "intensities\") {{\n"
        "    const auto parts = candela::sdk::reflected(CANDELA_PLUGIN_DIR, \"{}\", {}, 0, 60);\n"
        "    // Check the values that you expect, from your paper or worked out by hand.\n"
        "    for (const float part : {{parts.diffuse.x, parts.specular.x}}) {{\n"
        "        CHECK(std::isfinite(part));\n        CHECK(part >= 0);\n    }}\n}}\n",
        names.name, required_values(model.parameters));
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
                                     const ProjectNames& names, Description description) {
    const candela::PluginDescriptor& plugin = *model.descriptor;
    std::string text = renamed(kernel, plugin, names);
    if (description == Description::to_be_written)
        text = retitled(std::move(text), names.title,
                        fmt::format("Based on {}: one sentence about it.", plugin.title));
    return {{names.name + ".kernel", text + (text.ends_with('\n') ? "" : "\n")},
            {names.name + "_test.cpp", test_of(model.manifest, names)}};
}
