#include "plugin_project/plugin_project.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <map>
#include <regex>
#include <string_view>

#include "candela/target/literals.h"
#include "programs/sibling_program.h"

import candela.api;
import candela.util;

namespace fs = std::filesystem;
using candela::Error;
using candela::ErrorCategory;
using candela::ExportedFile;
using candela::ParamSpec;
using candela::ParamType;
using candela::target::float_text;

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

/// A text as a C++ string literal.
std::string literal_of(std::string_view text) {
    std::string result = "\"";
    for (const char c : text) {
        if (c == '\n') {
            result += "\\n";
        } else {
            if (c == '"' || c == '\\') result += '\\';
            result += c;
        }
    }
    return result + '"';
}

std::string numbers_of(const float (&number)[9], std::size_t count) {
    std::vector<std::string> texts;
    for (std::size_t i = 0; i < count; ++i) texts.push_back(float_text(number[i]));
    return fmt::format("{}", fmt::join(texts, ", "));
}

/// The declaration of one parameter, in the style of candela/plugin.h.
std::string field_of(const ParamSpec& p, const std::string& material) {
    const auto with = [&](const char* kind, const std::string& default_value) {
        return fmt::format("{}(&{}::{}, {}, {}{})", kind, material, p.name, literal_of(p.name),
                           default_value.empty() ? "" : default_value + ", ", literal_of(p.meaning));
    };
    const auto three = [&](const char* type) {
        return fmt::format("three(&{}::{}, candela::ParamType::{}, {}, candela::kernel::vec3({}), {})",
                           material, p.name, type, literal_of(p.name), numbers_of(p.default_value.number, 3),
                           literal_of(p.meaning));
    };
    std::string text;
    switch (p.type) {
        case ParamType::real:
            text = with("real", float_text(p.default_value.number[0]));
            break;
        case ParamType::integer:
            text = with("integer", fmt::to_string(p.default_value.integer));
            break;
        case ParamType::boolean:
            return with("boolean", p.default_value.integer != 0 ? "true" : "false");
        case ParamType::choice:
            return with("choice", fmt::format("k_{}_choices", p.name));
        case ParamType::matrix:
            return fmt::format("matrix(&{}::{}, {}, {}, {{{}}})", material, p.name, literal_of(p.name),
                               literal_of(p.meaning), numbers_of(p.default_value.number, 9));
        case ParamType::text:
        case ParamType::file:
        case ParamType::numbers:
            throw Error(ErrorCategory::bad_request,
                        fmt::format("the parameter '{}' is a {}, which new projects do not support", p.name,
                                    name_of(p.type)));
        default:
            text = three(std::string(name_of(p.type)).c_str());
    }
    if (std::isfinite(p.minimum))
        text += fmt::format(".{}({})", p.minimum_excluded ? "above" : "minimum", float_text(p.minimum));
    if (std::isfinite(p.maximum))
        text += fmt::format(".{}({})", p.maximum_excluded ? "below" : "maximum", float_text(p.maximum));
    if (*p.unit != '\0') text += fmt::format(".unit({})", literal_of(p.unit));
    if (p.required) text += ".required()";
    return text;
}

std::string relations_of(const candela::PluginDescriptor& plugin) {
    if (plugin.relations.empty()) return "";
    constexpr const char* k_types[] = {"less", "less_or_equal", "sum_at_most_one"};
    std::vector<std::string> rows;
    for (const candela::RelationSpec& relation : plugin.relations) {
        rows.push_back(fmt::format("    {{candela::RelationType::{}, {}, {}, {}, {}}}",
                                   k_types[static_cast<int>(relation.type)], literal_of(relation.left),
                                   literal_of(relation.right), relation.only_warns ? "true" : "false",
                                   literal_of(relation.meaning)));
    }
    return fmt::format("constexpr candela::RelationSpec k_relations[] = {{\n{}}};\n\n",
                       fmt::join(rows, ",\n"));
}

/// The members of Surface that the kernel reads, as CANDELA_REFLECTION_PLUGIN_READING takes them; empty if
/// they are only those that every model reads.
std::string reads_of(const std::string& kernel) {
    constexpr std::pair<const char*, const char*> k_reads[] = {
        {R"(\.\s*tangent\b|\btangent_or_any\b)", "reads_tangent"},
        {R"(\.\s*position\b)", "reads_position"},
        {R"(\.\s*uv\b)", "reads_uv"}};
    std::vector<std::string> reads;
    for (const auto& [pattern, name] : k_reads)
        if (std::regex_search(kernel, std::regex(pattern))) reads.emplace_back(name);
    return fmt::format("{}", fmt::join(reads, " | "));
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

std::string source_of(const candela::PluginDescriptor& plugin, const std::string& kernel,
                      const ProjectNames& names) {
    const std::string material = renamed(plugin.kernel.parameters, plugin, names);
    std::vector<std::string> fields;
    std::string choices;
    for (const ParamSpec& p : plugin.parameters) {
        fields.push_back("    " + field_of(p, material));
        if (p.type != ParamType::choice) continue;
        std::vector<std::string> words;
        for (const char* const word : p.choices) words.push_back(literal_of(word));
        choices +=
            fmt::format("constexpr const char* k_{}_choices[] = {{{}}};\n\n", p.name, fmt::join(words, ", "));
    }
    const std::string reads = reads_of(kernel);
    return fmt::format(
        "#include <candela/reflection_plugin.h>\n\nnamespace candela::kernel {{\n#include "
        "\"{0}.kernel\"\n}}\n\n"
        "using candela::kernel::{1};\nusing namespace candela::sdk;\n\n{2}constexpr auto k_fields = "
        "fields(\n{3});\n\n{4}"
        "// The conformance kit verifies the properties declared here: reciprocal, energy-bounded, "
        "isotropic …\n"
        "{5}({6}{7}, {1}, k_fields,\n    {{.title = {8},\n     .summary = \"One sentence about it.\",\n     "
        ".formula = {9}{10}}})\n",
        names.name, material, choices, fmt::join(fields, ",\n"), relations_of(plugin),
        reads.empty() ? "CANDELA_REFLECTION_PLUGIN" : "CANDELA_REFLECTION_PLUGIN_READING",
        reads.empty() ? "" : reads + ", ", names.ident, literal_of(names.title),
        literal_of(fmt::format("based on reflection/{}", plugin.name)),
        plugin.relations.empty() ? "" : ",\n     .relations = k_relations");
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
    const auto is_letter = [](char c) { return c >= 'a' && c <= 'z'; };
    const auto is_allowed = [&](char c) { return is_letter(c) || (c >= '0' && c <= '9') || c == '-'; };
    bool good = !name.empty() && is_letter(name.front()) && name.back() != '-' &&
                name.find("--") == std::string::npos;
    for (const char c : name) good = good && is_allowed(c);
    if (!good) {
        throw Error(ErrorCategory::bad_request,
                    fmt::format("'{}' is not a valid plugin name; expected lower-case letters, digits and "
                                "single hyphens, starting with a letter",
                                name));
    }
    ProjectNames names{.name = name, .ident = {}, .type = type_of(name, '-'), .title = {}};
    for (const char c : name) {
        names.ident += c == '-' ? '_' : c;
        names.title +=
            c == '-' ? ' ' : (names.title.empty() && is_letter(c) ? static_cast<char>(c - 'a' + 'A') : c);
    }
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
    if (*plugin.kernel.parameters == '\0')
        throw Error(ErrorCategory::bad_request,
                    fmt::format("reflection/{} has no parameters to start a project from", plugin.name));
    const std::string text = renamed(kernel, plugin, names);
    return {{names.name + ".kernel", text + (text.ends_with('\n') ? "" : "\n")},
            {names.name + ".cpp", source_of(plugin, text, names)},
            {names.name + "_test.cpp", test_of(names)}};
}
