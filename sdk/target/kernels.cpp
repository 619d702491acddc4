#include "candela/target/kernels.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "candela/embed.h"
#include "candela/kernel_language/lexer.h"
#include "candela/target/literals.h"

CANDELA_EMBED(candela_target_prelude, CANDELA_TARGET_PRELUDE);
CANDELA_EMBED(candela_target_tables, CANDELA_TARGET_TABLES);
CANDELA_EMBED(candela_target_tone, CANDELA_TARGET_TONE);

namespace candela::target {

namespace {

using kernel_language::code_of;
using kernel_language::Lexeme;
using kernel_language::text_at;

/// Everything that a kernel declares at the top: structs, functions.
std::vector<std::string> declared_names(std::string_view kernel) {
    std::vector<std::string> names;
    const std::vector<Lexeme> tokens = code_of(kernel);
    for (std::size_t i = 0; i < tokens.size(); ++i) {
        if (tokens[i].text == "struct" && text_at(tokens, i + 2) == "{")
            names.emplace_back(tokens[i + 1].text);
        if (tokens[i].text == "KERNEL" && text_at(tokens, i + 3) == "(")
            names.emplace_back(tokens[i + 2].text);
    }
    return names;
}

const KernelFunction* function_of(const ExportedModel& model, std::string_view name) {
    for (const KernelFunction& function : model.plugin->kernel.functions) {
        if (name == function.name) return &function;
    }
    return nullptr;
}

/// The names in a text, except those of the standard library.
std::set<std::string> names_in(std::string_view text) {
    std::set<std::string> names;
    for (const Lexeme& lexeme : code_of(text)) {
        if (lexeme.kind == Lexeme::Kind::name && !text.substr(0, lexeme.offset).ends_with("std::"))
            names.emplace(lexeme.text);
    }
    return names;
}

struct Paragraph {
    std::string text;
    std::vector<std::string> declares{};
    bool is_kept = false;
};

/// The names that the lines of a library declare: "struct X {", "inline vec3 x(", "const float x =".
std::vector<std::string> declared_by(const std::string& code) {
    const auto begins_declaration = [](std::string_view word) {
        return word == "KERNEL" || word == "inline" || word == "static" || word == "const";
    };
    const auto follows_name = [](std::string_view text) { return text == "(" || text == "{" || text == "="; };
    const auto is_in_type = [](const Lexeme& token) {
        return token.is_word() || std::string_view(":<>,").find(token.text) != std::string_view::npos;
    };
    std::vector<std::string> names;
    const std::vector<Lexeme> tokens = code_of(code);
    for (std::size_t i = 0; i < tokens.size(); ++i) {
        if (tokens[i].offset > 0 && code[tokens[i].offset - 1] != '\n') continue;
        if (tokens[i].text == "struct" && text_at(tokens, i + 2) == "{")
            names.emplace_back(tokens[i + 1].text);
        if (!begins_declaration(tokens[i].text)) continue;
        for (std::size_t k = i + 1; k < tokens.size() && is_in_type(tokens[k]); ++k) {
            if (!tokens[k].is_word() || !follows_name(text_at(tokens, k + 1))) continue;
            names.emplace_back(tokens[k].text);
            break;
        }
    }
    return names;
}

std::vector<Paragraph> paragraphs_of(const std::string& text) {
    std::vector<Paragraph> all;
    std::istringstream lines(text);
    lines.exceptions(std::ios::badbit);  // otherwise std::getline() swallows std::bad_alloc, and the rest is
                                         // lost
    std::string line, current;
    const auto end = [&] {
        if (current.empty()) return;
        all.push_back({.text = current, .declares = declared_by(current)});
        current.clear();
    };
    while (std::getline(lines, line)) {
        if (line.empty()) {
            end();
        } else {
            current += line + '\n';
        }
    }
    end();
    return all;
}

}  // namespace

std::string without_comments(std::string_view text) { return kernel_language::without_comments(text); }

std::string_view kernel_prelude() { return candela_target_prelude; }
std::string_view tone_kernel() { return candela_target_tone; }
std::string_view glsl_tables() { return candela_target_tables; }

bool has_parameters(const ExportedModel& model) {
    return !std::string_view(model.plugin->kernel.parameters).empty();
}

bool has_function(const ExportedModel& model, std::string_view name) {
    return function_of(model, name) != nullptr;
}

std::string call(const ExportedModel& model, std::string_view name, std::string_view parameters,
                 std::string_view arguments) {
    const KernelFunction* const function = function_of(model, name);
    const bool takes_them = function != nullptr && function->takes_parameters;
    return fmt::format("{}_{}({}{}{})", model.plugin->kernel.prefix, name, takes_them ? parameters : "",
                       takes_them && !arguments.empty() ? ", " : "", arguments);
}

std::string constants_type(const ExportedModel& model) {
    const KernelText& kernel = model.plugin->kernel;
    if (!has_function(model, "prepare")) return kernel.parameters;
    const std::string name = fmt::format("{}_prepare", kernel.prefix);
    const std::vector<Lexeme> tokens = code_of(kernel.text);
    for (std::size_t i = 0; i < tokens.size(); ++i) {
        if (tokens[i].text == "KERNEL" && text_at(tokens, i + 2) == name && text_at(tokens, i + 3) == "(")
            return std::string(tokens[i + 1].text);
    }
    throw std::runtime_error(
        fmt::format("the kernel of {} does not declare the return type of {}", model.id, name));
}

std::string prepared(const ExportedModel& model, const std::string& parameters) {
    return has_function(model, "prepare")
               ? fmt::format("{}_prepare({})", model.plugin->kernel.prefix, parameters)
               : parameters;
}

std::string parameters_text(const ExportedModel& model, const ExportedValues& values) {
    const PluginDescriptor& plugin = *model.plugin;
    std::vector<std::string> members;
    for (const std::size_t i : plugin.kernel.members)
        members.push_back(member_text(plugin.parameters[i], values.runtime[i]));
    return fmt::format("{}{{{}}}", plugin.kernel.parameters, fmt::join(members, ", "));
}

std::string struct_text(const ExportedModel& model, const ExportedValues& values) {
    return prepared(model, parameters_text(model, values));
}

std::vector<ExportedModel> models_of(const ExportedScene& scene) {
    std::vector<ExportedModel> all(scene.light_models.begin(), scene.light_models.end());
    all.insert(all.end(), scene.reflections.begin(), scene.reflections.end());
    all.insert(all.end(), scene.shadings.begin(), scene.shadings.end());
    return all;
}

void require_different_names(const ExportedScene& scene) {
    std::map<std::string, std::string> whose;
    std::vector<ExportedModel> all = models_of(scene);
    for (const ExportedObject& object : scene.objects) all.push_back(object.shape);
    for (const ExportedModel& model : all) {
        if (model.plugin->kernel.text == nullptr) continue;
        const std::string id = model.id;
        for (const std::string& name : declared_names(model.plugin->kernel.text)) {
            const auto [at, is_new] = whose.try_emplace(name, id);
            if (is_new || at->second == id) continue;
            throw std::runtime_error(
                fmt::format("the kernels of {} and {} both declare '{}', so they cannot be combined in one "
                            "program; use a name that begins with the model's own",
                            at->second, id, name));
        }
    }
}

std::string needed_parts(std::string_view library, const std::string& users) {
    std::vector<Paragraph> all = paragraphs_of(std::string(library));
    std::set<std::string> wanted = names_in(users);
    for (bool has_grown = true; has_grown;) {
        has_grown = false;
        for (Paragraph& p : all) {
            if (p.is_kept) continue;
            p.is_kept = p.declares.empty() || std::ranges::any_of(p.declares, [&](const std::string& name) {
                            return wanted.contains(name);
                        });
            if (!p.is_kept) continue;
            wanted.merge(names_in(p.text));
            has_grown = true;
        }
    }
    std::string result;
    for (const Paragraph& p : all) {
        if (p.is_kept) result += (result.empty() ? "" : "\n") + p.text;
    }
    return result;
}

}  // namespace candela::target
