// The built-in parts of the kernel language: types, their constructors, and the functions of
// candela/kernel/kernel.h.
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

/// The functions of numbers, vectors, matrices and tables, without those that prelude.kernel declares.
const Overloads& builtin_functions();
/// float(…), int(…), vec3(…) and so on.
const Overloads& builtin_constructors();

std::optional<Type> builtin_type(std::string_view name);
/// The name of a type that is not a struct.
std::string_view name_of(Type::Kind kind);

/// The number of components of a vector; 0 if the type is not one.
int components_of(Type type);
Type vector_of(int components);

inline constexpr Type k_bool{Type::Kind::boolean};
inline constexpr Type k_int{Type::Kind::integer};
inline constexpr Type k_float{Type::Kind::real};
inline constexpr Type k_mat3{Type::Kind::mat3};
inline constexpr Type k_table{Type::Kind::table};

}  // namespace candela::kernel_language
