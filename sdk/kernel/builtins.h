// What every kernel can use: types, their constructors, and the functions of candela/kernel.h.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "candela/kernel_language/syntax.h"

namespace candela::kernel_language {

struct Signature {
    std::vector<Type> arguments;
    Type result;
};

using Overloads = std::map<std::string, std::vector<Signature>, std::less<>>;

/// Those of numbers, vectors, matrices and tables. What prelude.kernel declares is not among them.
const Overloads& builtin_functions();
/// float(…), int(…), vec3(…) and so on.
const Overloads& builtin_constructors();

std::optional<Type> builtin_type(std::string_view name);
/// Of a type that is not a struct.
std::string_view name_of(Type::Kind kind);

/// How many components a vector has; 0 of what is not one.
int components_of(Type type);
Type vector_of(int components);

inline constexpr Type k_bool{Type::Kind::boolean};
inline constexpr Type k_int{Type::Kind::integer};
inline constexpr Type k_float{Type::Kind::real};
inline constexpr Type k_mat3{Type::Kind::mat3};
inline constexpr Type k_table{Type::Kind::table};

}  // namespace candela::kernel_language
