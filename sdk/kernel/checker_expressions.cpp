// The checker of expressions: types, names, arguments.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "checker.h"

import candela.util;

namespace candela::kernel_language {

namespace {

using Kind = Expression::Kind;

bool is_number(Type type) { return type == k_int || type == k_float; }
bool is_arithmetic(std::string_view sign) { return sign == "+" || sign == "-" || sign == "*" || sign == "/"; }

void make_real(Expression& expression) {
    if (expression.type != k_int) return;
    expression.becomes_real = true;
    expression.type = k_float;
}

/// The type of a product, sum, difference or quotient; none if there is no such operator.
Type arithmetic(std::string_view sign, Type a, Type b) {
    if (is_number(a) && is_number(b)) return a == k_int && b == k_int ? k_int : k_float;
    const bool is_vector = components_of(a) > 0, is_other_vector = components_of(b) > 0;
    if (is_vector && (a == b || is_number(b))) return a;
    if (is_other_vector && is_number(a)) return b;
    const Type vec3 = vector_of(3);
    if (a == k_mat3 && b == k_mat3 && sign != "/") return k_mat3;
    if (sign != "*") return {};
    if ((a == k_mat3 && is_number(b)) || (b == k_mat3 && is_number(a))) return k_mat3;
    if ((a == k_mat3 && b == vec3) || (a == vec3 && b == k_mat3)) return vec3;
    return {};
}

}  // namespace

bool is_swizzle(const Expression& expression) {
    return expression.kind == Kind::member && components_of(expression.operands.front().type) > 0 &&
           expression.text.size() > 1;
}

Type Checker::check(Expression& expression) {
    Type type{};
    switch (expression.kind) {
        case Kind::integer:
            type = k_int;
            break;
        case Kind::real:
            type = k_float;
            break;
        case Kind::boolean:
            type = k_bool;
            break;
        case Kind::variable:
            type = variable(expression);
            break;
        case Kind::member:
            type = member(expression);
            break;
        case Kind::index:
            type = index(expression);
            break;
        case Kind::call:
            type = call(expression);
            break;
        case Kind::unary:
            type = unary(expression);
            break;
        case Kind::binary:
            type = binary(expression);
            break;
        case Kind::conditional:
            type = conditional(expression);
            break;
    }
    count(1, numbers_in(type), expression.place);
    return expression.type = type;
}

void Checker::check_as(Expression& expression, Type wanted, std::string_view what) {
    if (expression.type.kind == Type::Kind::none) check(expression);
    if (wanted == k_float) make_real(expression);
    if (expression.type == wanted) return;
    std::string hint;
    if (wanted == k_int && expression.type == k_float) hint = "; int(x) drops the fraction";
    if (wanted == k_bool && is_number(expression.type)) hint = "; compare it, as in x != 0";
    if (components_of(wanted) > 0 && is_number(expression.type))
        hint = fmt::format("; {}(x) has it in all components", text_of(wanted));
    throw Refusal{expression.place, fmt::format("{} {}, but this is {}{}", what, text_of(wanted),
                                                text_of(expression.type), hint)};
}

Type Checker::variable(const Expression& expression) const {
    const std::string& name = expression.text;
    if (name == being_declared_)
        throw Refusal{expression.place, fmt::format("'{}' is read in its own declaration", name)};
    if (const std::size_t* const number = seen_as(name)) {
        if (!assigned_[*number] && is_reachable_)
            throw Refusal{expression.place,
                          fmt::format("'{}' may be read here before it has a value; give it "
                                      "one where it is declared",
                                      name)};
        return seen_[*number].type;
    }
    refuse_unknown(expression);
}

void Checker::refuse_unknown(const Expression& expression) const {
    const std::string& name = expression.text;
    if (builtin_functions().contains(name) || declared_.functions.contains(name))
        throw Refusal{expression.place,
                      fmt::format("'{}' is a function; call it with arguments in ()", name)};
    if (const auto type = builtin_type(name))
        throw Refusal{expression.place, fmt::format("'{0}' is a type; make a value with {0}(…)", name)};
    std::vector<std::string> names;
    for (const auto& [each, numbers] : visible_)
        if (!numbers.empty()) names.push_back(each);
    const std::string meant = suggestion(name, names);
    throw Refusal{expression.place,
                  fmt::format("unknown variable '{}'{}", shortened(name), meant.empty() ? "" : "; " + meant)};
}

Type Checker::unary(Expression& expression) {
    const Type type = check(expression.operands.front());
    if (expression.text == "!") {
        if (type == k_bool) return type;
        throw Refusal{expression.place, fmt::format("'!' is for bool, but this is {}", text_of(type))};
    }
    if (is_number(type) || components_of(type) > 0) return type;
    throw Refusal{expression.place,
                  fmt::format("'-' is for numbers and vectors, but this is {}", text_of(type))};
}

Type Checker::binary(Expression& expression) {
    const std::string& sign = expression.text;
    const Type a = check(expression.operands[0]), b = check(expression.operands[1]);
    const auto refuse = [&](std::string_view hint) {
        throw Refusal{expression.place,
                      fmt::format("'{}' does not take {} and {}{}", sign, text_of(a), text_of(b), hint)};
    };
    if (sign == "&&" || sign == "||") {
        if (a != k_bool || b != k_bool) refuse("; both sides must be conditions");
        return k_bool;
    }
    if (sign == "%") {
        if (a != k_int || b != k_int) refuse("; the remainder of floats is mod(x, y)");
        return k_int;
    }
    if (is_arithmetic(sign)) {
        const Type type = arithmetic(sign, a, b);
        if (type.kind == Type::Kind::none) refuse("");
        if (type != k_int)
            for (Expression& operand : expression.operands) make_real(operand);
        return type;
    }
    const bool is_equality = sign == "==" || sign == "!=";
    if (is_equality && a == k_bool && b == k_bool) return k_bool;
    if (!is_number(a) || !is_number(b))
        refuse(components_of(a) > 0 ? "; vectors are compared component by component, as in a.x < b.x" : "");
    if (a != b)
        for (Expression& operand : expression.operands) make_real(operand);
    return k_bool;
}

Type Checker::swizzle(const Expression& expression, Type of) const {
    const std::string& name = expression.text;
    constexpr std::string_view k_components = "xyzw";
    const std::string_view known = k_components.substr(0, static_cast<std::size_t>(components_of(of)));
    const bool is_one = name.size() <= 4 && name.find_first_not_of(known) == std::string::npos;
    if (!is_one) {
        const bool is_color = name.find_first_not_of("rgba") == std::string::npos;
        throw Refusal{expression.place,
                      fmt::format("{} has no '{}'; its components are {}{}", text_of(of), shortened(name),
                                  fmt::join(known, ", "), is_color ? ", even for colours" : "")};
    }
    if (is_swizzle(expression.operands.front()))
        throw Refusal{expression.place, "a swizzle cannot be swizzled again"};
    return vector_of(static_cast<int>(name.size()));
}

Type Checker::member(Expression& expression) {
    const Type of = check(expression.operands.front());
    if (components_of(of) > 0) return swizzle(expression, of);
    if (of.kind != Type::Kind::structure)
        throw Refusal{expression.place, fmt::format("{} has no members", text_of(of))};
    const std::vector<Variable>& members =
        declared_.structures[static_cast<std::size_t>(of.structure)].members;
    const auto found = std::ranges::find(members, expression.text, &Variable::name);
    if (found != members.end()) return found->type.type;
    std::vector<std::string> names;
    for (const Variable& each : members) names.push_back(each.name);
    const std::string meant = suggestion(expression.text, names);
    throw Refusal{expression.place,
                  fmt::format("{} has no member '{}'; {}", text_of(of), shortened(expression.text),
                              meant.empty() ? fmt::format("it has {}", fmt::join(names, ", ")) : meant)};
}

Type Checker::index(Expression& expression) {
    const Type of = check(expression.operands[0]);
    check(expression.operands[1]);
    if (of != k_mat3)
        throw Refusal{expression.place,
                      "the kernel language has neither arrays nor attributes; a vector's "
                      "components are v.x, v.y, v.z"};
    const auto column = value_of(expression.operands[1]);
    if (!column || *column < 0 || *column > 2)
        throw Refusal{expression.operands[1].place, "the columns of a matrix are m[0], m[1] and m[2]"};
    return vector_of(3);
}

Type Checker::conditional(Expression& expression) {
    check_as(expression.operands[0], k_bool, "what stands before '?' is");
    const Type a = check(expression.operands[1]), b = check(expression.operands[2]);
    if (a == b) return a;
    if (!is_number(a) || !is_number(b))
        throw Refusal{expression.place,
                      fmt::format("both values of '?' must have the same type; these are {} and {}",
                                  text_of(a), text_of(b))};
    make_real(expression.operands[1]);
    make_real(expression.operands[2]);
    return k_float;
}

const Signature* Checker::fitting(const Expression& call, const std::vector<Signature>& overloads) const {
    // First as they are, then with integers converted to real numbers.
    for (const bool converts : {false, true}) {
        for (const Signature& each : overloads) {
            const bool fits =
                std::ranges::equal(call.operands, each.arguments, [&](const Expression& given, Type wanted) {
                    return given.type == wanted || (converts && given.type == k_int && wanted == k_float);
                });
            if (fits) return &each;
        }
    }
    return nullptr;
}

Type Checker::called(Expression& call, const std::vector<Signature>& overloads) {
    if (const Signature* const signature = fitting(call, overloads)) {
        for (std::size_t i = 0; i < call.operands.size(); ++i)
            if (signature->arguments[i] == k_float) make_real(call.operands[i]);
        return signature->result;
    }
    const auto types = [&](const auto& all, const auto& type_in) {
        std::vector<std::string> names;
        for (const auto& each : all) names.push_back(text_of(type_in(each)));
        return fmt::format("{}({})", call.text, fmt::join(names, ", "));
    };
    std::vector<std::string> possible;
    for (const Signature& each : overloads)
        possible.push_back(types(each.arguments, [](Type type) { return type; }));
    throw Refusal{call.place,
                  fmt::format("there is no {}; there is {}",
                              types(call.operands, [](const Expression& each) { return each.type; }),
                              fmt::join(possible, ", "))};
}

Type Checker::call(Expression& expression) {
    const std::string& name = expression.text;
    if (seen_as(name) != nullptr || name == being_declared_)
        throw Refusal{expression.place, fmt::format("'{}' is a variable here and cannot be called", name)};
    for (Expression& argument : expression.operands) check(argument);
    if (const auto found = builtin_constructors().find(name); found != builtin_constructors().end())
        return called(expression, found->second);
    for (std::size_t i = 0; i < declared_.structures.size(); ++i) {
        const Structure& structure = declared_.structures[i];
        if (structure.name != name) continue;
        Signature constructor{{}, {Type::Kind::structure, static_cast<std::int32_t>(i)}};
        for (const Variable& each : structure.members) constructor.arguments.push_back(each.type.type);
        return called(expression, {constructor});
    }
    if (const auto found = declared_.functions.find(name); found != declared_.functions.end()) {
        count(found->second.steps, found->second.size, expression.place);
        return called(expression, {found->second.signature});
    }
    if (const auto found = builtin_functions().find(name); found != builtin_functions().end())
        return called(expression, found->second);
    if (name == function_)
        throw Refusal{expression.place, fmt::format("{}() calls itself; recursion is not allowed", name)};
    if (functions_to_come_.contains(name))
        throw Refusal{expression.place,
                      fmt::format("{}() is declared further down; move it before {}()", name, function_)};
    std::vector<std::string> names;
    for (const auto& [each, callable] : declared_.functions) names.push_back(each);
    for (const auto& [each, overloads] : builtin_functions()) names.push_back(each);
    for (const std::string& each : known_types()) names.push_back(each);
    const std::string meant = suggestion(name, names);
    throw Refusal{expression.place,
                  fmt::format("unknown function '{}'{}", shortened(name), meant.empty() ? "" : "; " + meant)};
}

std::optional<std::int64_t> Checker::value_of(const Expression& expression) const {
    constexpr std::int64_t k_largest = 2147483647;
    const auto within = [](std::int64_t value) -> std::optional<std::int64_t> {
        if (value < -k_largest || value > k_largest) return std::nullopt;
        return value;
    };
    if (expression.type != k_int) return std::nullopt;
    if (expression.kind == Kind::integer) return std::strtoll(expression.text.c_str(), nullptr, 10);
    if (expression.kind == Kind::variable) {
        const std::size_t* const number = seen_as(expression.text);
        return number == nullptr ? std::nullopt : seen_[*number].value;
    }
    if (expression.kind == Kind::unary) {
        const auto value = value_of(expression.operands.front());
        return value ? within(-*value) : value;
    }
    if (expression.kind != Kind::binary) return std::nullopt;
    const auto a = value_of(expression.operands[0]), b = value_of(expression.operands[1]);
    if (!a || !b) return std::nullopt;
    if (expression.text == "+") return within(*a + *b);
    if (expression.text == "-") return within(*a - *b);
    if (expression.text == "*") return within(*a * *b);
    if (*b == 0) return std::nullopt;
    return within(expression.text == "/" ? *a / *b : *a % *b);
}

bool Checker::is_constant(const Expression& expression) const {
    if (expression.kind == Kind::call && !builtin_constructors().contains(expression.text)) return false;
    return std::ranges::all_of(expression.operands,
                               [&](const Expression& each) { return is_constant(each); });
}

}  // namespace candela::kernel_language
