#include "builtins.h"

#include <array>
#include <initializer_list>
#include <utility>

namespace candela::kernel_language {

namespace {

constexpr std::array<std::pair<std::string_view, Type::Kind>, 8> k_types{{{"bool", Type::Kind::boolean},
                                                                          {"int", Type::Kind::integer},
                                                                          {"float", Type::Kind::real},
                                                                          {"vec2", Type::Kind::vec2},
                                                                          {"vec3", Type::Kind::vec3},
                                                                          {"vec4", Type::Kind::vec4},
                                                                          {"mat3", Type::Kind::mat3},
                                                                          {"Table", Type::Kind::table}}};
constexpr std::array<int, 3> k_sizes = {2, 3, 4};

Overloads made_functions() {
    Overloads all;
    const auto add = [&](const char* name, std::vector<Type> arguments, Type result) {
        all[name].push_back({std::move(arguments), result});
    };
    // Functions of numbers and, component by component, of vectors.
    const auto componentwise = [&](std::initializer_list<const char*> names, std::size_t count) {
        for (const char* const name : names) {
            add(name, std::vector<Type>(count, k_float), k_float);
            for (const int size : k_sizes)
                add(name, std::vector<Type>(count, vector_of(size)), vector_of(size));
        }
    };
    for (const char* const name : {"min", "max"}) add(name, {k_int, k_int}, k_int);
    componentwise(
        {"abs", "sign", "floor",   "trunc",   "ceil", "fract", "sqrt", "inversesqrt", "exp",  "exp2",
         "log", "log2", "radians", "degrees", "sin",  "cos",   "tan",  "asin",        "acos", "atan"},
        1);
    componentwise({"atan", "pow", "mod", "min", "max", "step"}, 2);
    componentwise({"clamp", "mix", "smoothstep"}, 3);
    for (const int size : k_sizes) {
        const Type v = vector_of(size);
        for (const char* const name : {"mod", "min", "max"}) add(name, {v, k_float}, v);
        add("step", {k_float, v}, v);
        add("clamp", {v, k_float, k_float}, v);
        add("mix", {v, v, k_float}, v);
        add("smoothstep", {k_float, k_float, v}, v);
        add("dot", {v, v}, k_float);
        add("length", {v}, k_float);
        add("distance", {v, v}, k_float);
        add("normalize", {v}, v);
        add("reflect", {v, v}, v);
    }
    const Type vec3 = vector_of(3);
    add("cross", {vec3, vec3}, vec3);
    add("refract", {vec3, vec3, k_float}, vec3);
    add("transpose", {k_mat3}, k_mat3);
    add("inverse", {k_mat3}, k_mat3);
    add("determinant", {k_mat3}, k_float);
    add("table_size", {k_table}, k_int);
    add("table_at", {k_table, k_int}, k_float);
    return all;
}

Overloads made_constructors() {
    const Type vec2 = vector_of(2), vec3 = vector_of(3), vec4 = vector_of(4);
    Overloads all;
    // An argument that already has the wanted type is used unchanged, so that no number is converted first.
    all["float"] = {{{k_float}, k_float}, {{k_int}, k_float}, {{k_bool}, k_float}};
    all["int"] = {{{k_int}, k_int}, {{k_float}, k_int}, {{k_bool}, k_int}};
    all["vec2"] = {{{k_float}, vec2}, {{k_float, k_float}, vec2}, {{vec2}, vec2}};
    all["vec3"] = {{{k_float}, vec3},
                   {{k_float, k_float, k_float}, vec3},
                   {{vec2, k_float}, vec3},
                   {{k_float, vec2}, vec3},
                   {{vec3}, vec3}};
    all["vec4"] = {{{k_float}, vec4},       {{k_float, k_float, k_float, k_float}, vec4},
                   {{vec3, k_float}, vec4}, {{k_float, vec3}, vec4},
                   {{vec2, vec2}, vec4},    {{vec4}, vec4}};
    all["mat3"] = {{{k_float}, k_mat3}, {{vec3, vec3, vec3}, k_mat3}, {{k_mat3}, k_mat3}};
    return all;
}

}  // namespace

const Overloads& builtin_functions() {
    static const Overloads k_all = made_functions();
    return k_all;
}

const Overloads& builtin_constructors() {
    static const Overloads k_all = made_constructors();
    return k_all;
}

std::optional<Type> builtin_type(std::string_view name) {
    for (const auto& [each, kind] : k_types)
        if (each == name) return Type{kind};
    return std::nullopt;
}

std::string_view name_of(Type::Kind kind) {
    for (const auto& [name, each] : k_types)
        if (each == kind) return name;
    return "?";
}

int components_of(Type type) {
    switch (type.kind) {
        case Type::Kind::vec2:
            return 2;
        case Type::Kind::vec3:
            return 3;
        case Type::Kind::vec4:
            return 4;
        default:
            return 0;
    }
}

Type vector_of(int components) {
    return {components == 2   ? Type::Kind::vec2
            : components == 3 ? Type::Kind::vec3
            : components == 4 ? Type::Kind::vec4
                              : Type::Kind::real};
}

}  // namespace candela::kernel_language
