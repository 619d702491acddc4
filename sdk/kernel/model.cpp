#include "candela/kernel_language/model.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <stdexcept>

#include "documentation.h"
#include "prelude.h"
#include "tokens.h"

import candela.api;
import candela.plugins;
import candela.util;

namespace candela::kernel_language {

namespace {

/// The functions that make a model of each kind: <prefix>_<name>.
struct KindFunctions {
    PluginKind kind;
    std::vector<std::string_view> first;  // one of which a model has
    std::vector<std::string_view> others;
};

const std::vector<KindFunctions>& all_kinds() {
    static const std::vector<KindFunctions> k_kinds = {
        {PluginKind::reflection,
         {"reflect"},
         {"reflect_ambient", "highlight_width", "enter", "leave", "transmit", "prepare"}},
        {PluginKind::light,
         {"illuminate", "illuminate_ambient"},
         {"sample_count", "punctual", "extent", "distance", "seen", "prepare"}},
        {PluginKind::shading, {"normal"}, {"corner_weight", "prepare"}}};
    return k_kinds;
}

using Functions = std::map<std::string, const Function*, std::less<>>;

void add_functions(const std::vector<Declaration>& declarations, Functions& functions) {
    for (const Declaration& declaration : declarations)
        if (const auto* const function = std::get_if<Function>(&declaration))
            functions.emplace(function->name, function);
}

/// Follows the calls of a model's functions, and notes which members they read of each struct.
class ReadsFinder {
  public:
    ReadsFinder(const Kernel& kernel, const Functions& functions) : kernel_(kernel), functions_(functions) {}

    void follow(const Function& function) {
        if (!followed_.insert(function.name).second) return;
        for (const Statement& statement : function.body) follow(statement);
    }

    std::set<std::string> members_of(std::string_view structure) const {
        const auto found = reads_.find(structure);
        return found == reads_.end() ? std::set<std::string>() : found->second;
    }

  private:
    void follow(const Statement& statement) {
        for (const Expression& expression : statement.expressions) follow(expression);
        for (const Statement& inner : statement.statements) follow(inner);
    }

    void follow(const Expression& expression) {
        for (const Expression& operand : expression.operands) follow(operand);
        if (expression.kind == Expression::Kind::member) {
            const Type of = expression.operands.front().type;
            if (of.kind == Type::Kind::structure)
                reads_[kernel_.structures[static_cast<std::size_t>(of.structure)]].insert(expression.text);
        } else if (expression.kind == Expression::Kind::call) {
            const auto called = functions_.find(expression.text);
            if (called != functions_.end()) follow(*called->second);
        }
    }

    const Kernel& kernel_;
    const Functions& functions_;
    std::set<std::string> followed_;
    std::map<std::string, std::set<std::string>, std::less<>> reads_;
};

class ModelReader {
  public:
    ModelReader(const Kernel& kernel, std::string_view name) : kernel_(kernel) {
        model_.name = name;
        model_.prefix = name;
        std::ranges::replace(model_.prefix, '-', '_');
        add_functions(prelude_declarations(), functions_);
        add_functions(kernel.declarations, functions_);
    }

    ModelDeclaration read() {
        find_kind();
        read_documentation(first_comment(text()), model_);
        find_structure();
        check_declarations(model_);
        if (model_.title.empty()) model_.title = usual_title();
        if (model_.summary.empty())
            model_.summary = fmt::format("A {} model from {}.kernel.", name_of(model_.kind), model_.name);
        if (model_.rate.empty() && model_.kind == PluginKind::shading) model_.rate = "fragment";
        ReadsFinder finder(kernel_, functions_);
        for (const std::string& name : model_.functions) finder.follow(*function(name));
        model_.reads = {.surface = finder.members_of("Surface"),
                        .receiver = finder.members_of("Receiver"),
                        .shading_point = finder.members_of("ShadingPoint")};
        if (const Function* const normal = function("normal"))
            model_.takes_triangle = std::ranges::any_of(
                normal->parameters, [](const Variable& each) { return each.type.name == "Triangle"; });
        return std::move(model_);
    }

  private:
    const std::string& text() const { return kernel_.sources.front().text; }

    const Function* function(std::string_view name) const {
        const auto found = functions_.find(fmt::format("{}_{}", model_.prefix, name));
        return found == functions_.end() ? nullptr : found->second;
    }

    void find_kind() {
        for (const KindFunctions& kind : all_kinds()) {
            const bool is_of_kind = std::ranges::any_of(
                kind.first, [&](std::string_view name) { return function(name) != nullptr; });
            if (!is_of_kind) continue;
            model_.kind = kind.kind;
            for (const auto* const names : {&kind.first, &kind.others})
                for (const std::string_view name : *names)
                    if (function(name) != nullptr) model_.functions.emplace(name);
            require_functions();
            return;
        }
        const std::string needed = fmt::format(
            "a model named '{0}' needs a function {1}_reflect (a reflection model), {1}_illuminate or "
            "{1}_illuminate_ambient (a light) or {1}_normal (a shading model)",
            model_.name, model_.prefix);
        for (const Declaration& declaration : kernel_.declarations) {
            const auto* const function = std::get_if<Function>(&declaration);
            if (function == nullptr) continue;
            if (std::string other = model_of(function->name); !other.empty())
                throw Refusal{function->name_place, fmt::format("{}; this is {}, of a model named '{}'",
                                                                needed, function->name, other)};
        }
        throw Refusal{{}, needed};
    }

    /// The model that needs a function of that name: "as" for as_reflect; empty if none does.
    static std::string model_of(std::string_view function) {
        for (const KindFunctions& kind : all_kinds())
            for (const std::string_view name : kind.first)
                if (function.ends_with(fmt::format("_{}", name))) {
                    std::string model(function.substr(0, function.size() - name.size() - 1));
                    std::ranges::replace(model, '_', '-');
                    return model;
                }
        return {};
    }

    void require_functions() const {
        const auto require = [&](const char* present, std::initializer_list<const char*> needed) {
            if (!model_.functions.contains(present)) return;
            for (const char* const name : needed)
                if (!model_.functions.contains(name))
                    throw Refusal{
                        function(present)->name_place,
                        fmt::format("a model with {0}_{1} also needs {0}_{2}", model_.prefix, present, name)};
        };
        require("reflect", {"reflect_ambient"});
        if (model_.functions.contains("enter") && model_.functions.contains("highlight_width"))
            throw Refusal{
                function("highlight_width")->name_place,
                fmt::format("a transparent model, with {0}_enter, mirrors its surroundings sharply; "
                            "remove {0}_highlight_width",
                            model_.prefix)};
        require("enter", {"leave", "transmit"});
        require("leave", {"enter"});
        require("transmit", {"enter"});
    }

    /// The struct of parameters is the first argument: of prepare, if it exists, otherwise of the others.
    void find_structure() {
        const Function* const prepare = function("prepare");
        if (prepare != nullptr) model_.constants = prepare->result.name;
        const Structure* parameters = nullptr;
        for (const std::string& name : model_.functions) {
            const std::vector<Variable>& arguments = function(name)->parameters;
            if (arguments.empty() || (prepare != nullptr && name != "prepare")) continue;
            for (const Declaration& declaration : kernel_.declarations) {
                const auto* const each = std::get_if<Structure>(&declaration);
                if (each != nullptr && each->name == arguments.front().type.name) parameters = each;
            }
        }
        if (parameters == nullptr) return;
        model_.structure = parameters->name;
        for (const Variable& member : parameters->members)
            model_.parameters.push_back(read_parameter(member, comment_behind(text(), member.place.offset)));
    }

    std::string usual_title() const {
        std::string title = model_.name;
        std::ranges::replace(title, '-', ' ');
        if (title[0] >= 'a' && title[0] <= 'z') title[0] = static_cast<char>(title[0] - 'a' + 'A');
        return title;
    }

    const Kernel& kernel_;
    Functions functions_;
    ModelDeclaration model_;
};

}  // namespace

std::string model_name(const std::filesystem::path& file) {
    const std::string name = file.stem().string();
    if (!is_plugin_name(name) || file.extension() != ".kernel") {
        throw std::invalid_argument(
            fmt::format("'{}' is not a valid name of a model's file; expected lower-case letters, digits and "
                        "single hyphens, starting with a letter, and '.kernel'",
                        file.filename().string()));
    }
    return name;
}

ModelDeclaration read_model(const Kernel& kernel, std::string_view name) {
    try {
        return ModelReader(kernel, name).read();
    } catch (const Refusal& refusal) {
        throw problem_at(kernel.sources[refusal.place.source], refusal.place.offset, refusal.message);
    }
}

}  // namespace candela::kernel_language
