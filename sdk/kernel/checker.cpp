#include "checker.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "candela/kernel_language/language.h"

import candela.util;

namespace candela::kernel_language {

void Checker::check(std::vector<Declaration>& declarations) {
    open_scope();
    for (const Declaration& each : declarations)
        if (const auto* const function = std::get_if<Function>(&each))
            functions_to_come_.emplace(function->name, function->name_place);
    for (Declaration& each : declarations) {
        if (auto* const its = std::get_if<Structure>(&each)) structure(*its);
        if (auto* const its = std::get_if<Constant>(&each)) constant(*its);
        if (auto* const its = std::get_if<Function>(&each)) function(*its);
    }
    close_scope();
}

std::string Checker::text_of(Type type) const {
    if (type.kind == Type::Kind::structure)
        return declared_.structures[static_cast<std::size_t>(type.structure)].name;
    return std::string(name_of(type.kind));
}

std::uint64_t Checker::numbers_in(Type type) const {
    switch (type.kind) {
        case Type::Kind::structure:
            return declared_.structures[static_cast<std::size_t>(type.structure)].numbers;
        case Type::Kind::mat3:
            return 9;
        case Type::Kind::table:
            return 3;  // an address takes two
        default:
            return std::max<std::uint64_t>(1, static_cast<std::uint64_t>(components_of(type)));
    }
}

std::vector<std::string> Checker::known_types() const {
    std::vector<std::string> names = {"float", "int", "bool", "vec2", "vec3", "vec4", "mat3", "Table"};
    for (const Structure& structure : declared_.structures) names.push_back(structure.name);
    return names;
}

void Checker::resolve(TypeName& type) const {
    if (const auto builtin = builtin_type(type.name)) {
        type.type = *builtin;
        return;
    }
    for (std::size_t i = 0; i < declared_.structures.size(); ++i) {
        if (declared_.structures[i].name != type.name) continue;
        type.type = {Type::Kind::structure, static_cast<std::int32_t>(i)};
        return;
    }
    const std::string meant = suggestion(type.name, known_types());
    throw Refusal{
        type.place,
        fmt::format("unknown type '{}'; {}", shortened(type.name),
                    meant.empty() ? "the types are float, int, bool, vec2, vec3, vec4, mat3, Table, structs "
                                    "of the kernel, and those of every kernel, such as Surface"
                                  : meant)};
}

void Checker::require_new_name(const std::string& name, TextPosition place) {
    if (builtin_type(name) || std::ranges::any_of(declared_.structures, [&](const Structure& structure) {
            return structure.name == name;
        }))
        throw Refusal{place, fmt::format("'{}' is the name of a type; choose another", name)};
    if (is_glsl_function(name))
        throw Refusal{
            place,
            fmt::format("'{}' is a function of GLSL, the language of shaders; choose another name", name)};
    if (builtin_functions().contains(name) || declared_.functions.contains(name))
        throw Refusal{place, fmt::format("'{}' is a function already; choose another name", name)};
    if (seen_as(name) != nullptr)
        throw Refusal{place, fmt::format("'{}' is a constant already; choose another name", name)};
}

void Checker::structure(Structure& structure) {
    require_new_name(structure.name, structure.place);
    if (structure.members.empty())
        throw Refusal{structure.place, fmt::format("struct {} has no members", structure.name)};
    std::set<std::string> names;
    for (Variable& member : structure.members) {
        resolve(member.type);
        // glslangValidator takes it for the method of arrays, whatever stands before the point.
        if (member.name == "length")
            throw Refusal{
                member.place,
                "a member cannot be called 'length', which is a method in GLSL; choose another name"};
        if (!names.insert(member.name).second)
            throw Refusal{member.place, fmt::format("'{}' is a member already", member.name)};
        structure.numbers += numbers_in(member.type.type);
        if (structure.numbers > k_largest_struct)
            throw Refusal{member.place, fmt::format("struct {} holds more than {} numbers", structure.name,
                                                    k_largest_struct)};
    }
    declared_.structures.push_back(structure);
}

void Checker::constant(Constant& constant) {
    Statement& declaration = constant.declaration;
    require_new_name(declaration.name, declaration.name_place);
    declare(declaration);
    const Expression& value = declaration.expressions.front();
    if (!is_constant(value))
        throw Refusal{value.place,
                      "a constant outside functions may consist only of numbers, constants, operators and "
                      "constructors"};
}

void Checker::function(Function& function) {
    require_new_name(function.name, function.name_place);
    resolve(function.result);
    function_ = function.name;
    result_ = function.result.type;
    is_reachable_ = true;
    loops_ = 0;
    iterations_ = 1;
    steps_ = size_ = 0;
    open_scope();
    std::vector<Type> arguments;
    for (Variable& parameter : function.parameters) {
        resolve(parameter.type);
        arguments.push_back(parameter.type.type);
        see(parameter.name, parameter.place,
            {.type = parameter.type.type, .is_constant = parameter.is_constant}, true);
    }
    statements(function.body);
    close_scope();
    if (is_reachable_) {
        // An answer is only a body, so the missing return is reported at its end.
        const TextPosition at = function.body.empty() ? function.end : function.body.back().place;
        throw Refusal{at, fmt::format("{}() has a path to its end that returns nothing", function.name)};
    }
    function.steps = steps_;
    function.size = size_;
    function_.clear();
    functions_to_come_.erase(function.name);
    declared_.functions.emplace(
        function.name, Declared::Callable{{std::move(arguments), function.result.type}, steps_, size_});
}

void Checker::see(const std::string& name, TextPosition place, Seen seen, bool is_assigned) {
    if (builtin_type(name) || std::ranges::any_of(declared_.structures, [&](const Structure& structure) {
            return structure.name == name;
        }))
        throw Refusal{place, fmt::format("'{}' is the name of a type; choose another", name)};
    if (!scopes_.back().insert(name).second)
        throw Refusal{place, fmt::format("'{}' is declared already", name)};
    visible_[name].push_back(seen_.size());
    seen_.push_back(seen);
    assigned_.push_back(is_assigned);
}

const std::size_t* Checker::seen_as(std::string_view name) const {
    const auto found = visible_.find(name);
    return found == visible_.end() || found->second.empty() ? nullptr : &found->second.back();
}

void Checker::close_scope() {
    for (const std::string& name : scopes_.back()) visible_[name].pop_back();
    scopes_.pop_back();
}

void Checker::count(std::uint64_t steps, std::uint64_t size, TextPosition place) {
    steps_ += steps;
    size_ += size;
    if (steps_ > k_most_steps)
        throw Refusal{place, fmt::format("up to here, a call of {}() may take more than {} steps", function_,
                                         k_most_steps)};
    if (size_ > k_largest_size)
        throw Refusal{place, fmt::format("up to here, {}() is too large: with all the functions that it "
                                         "calls, it may compute {} numbers",
                                         function_, k_largest_size)};
}

}  // namespace candela::kernel_language
