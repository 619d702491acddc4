// A kernel as read by the parser and understood by the checker.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace candela::kernel_language {

/// Where something begins: the byte, and the index of its text among the kernel's (see Kernel::sources).
struct TextPosition {
    std::uint32_t offset = 0;
    std::uint8_t source = 0;
};

/// The types of the language. A struct is identified by its number among all structs (see Checker).
struct Type {
    enum class Kind : std::uint8_t { none, boolean, integer, real, vec2, vec3, vec4, mat3, table, structure };
    Kind kind = Kind::none;
    std::int32_t structure = -1;
    friend bool operator==(const Type&, const Type&) = default;
};

/// A type as written, and what it resolves to.
struct TypeName {
    std::string name{};
    Type type{};
    TextPosition place{};
};

struct Expression {
    enum class Kind : std::uint8_t {
        integer,
        real,
        boolean,
        variable,
        member,  // of a struct or a vector: operand 0
        index,   // a column of a matrix: operand 0, by operand 1
        call,    // of a function or a constructor, by its name
        unary,
        binary,
        conditional
    };
    Kind kind = Kind::integer;
    Type type{};
    TextPosition place{};  // of the name or the operator
    std::string text{};    // the literal, the name or the operator
    std::vector<Expression> operands{};
    std::uint32_t depth = 1;    // of the tree
    bool becomes_real = false;  // an integer where a real number is expected
};

struct Statement {
    enum class Kind : std::uint8_t { block, declare, assign, branch, loop, result, leave, next };
    Kind kind = Kind::block;
    TextPosition place{};
    bool is_constant = false;  // of `declare`
    TypeName type{};           // of `declare`
    std::string name{};        // what is declared, or the operator of `assign`: "=", "+=", "++"
    TextPosition name_place{};
    /// declare: the initialiser, if any. assign: the target, then the value, except for ++ and --. branch:
    /// the condition. loop: the condition. result: the value.
    std::vector<Expression> expressions{};
    /// block: all. branch: the true branch and, if there is one, the else branch. loop: the first
    /// declaration, the step, and the body.
    std::vector<Statement> statements{};
};

struct Variable {
    bool is_constant = false;
    TypeName type{};
    std::string name{};
    TextPosition place{};
};

struct Structure {
    std::string name{};
    TextPosition place{};
    std::vector<Variable> members{};
    TextPosition end{};
    std::uint64_t numbers = 0;  // in it, including those of its members' structs
};

struct Constant {
    Statement declaration{};
};

struct Function {
    TypeName result{};
    std::string name{};
    TextPosition place{};  // of KERNEL
    TextPosition name_place{};
    std::vector<Variable> parameters{};
    TextPosition begin{};  // of the body's opening brace
    std::vector<Statement> body{};
    TextPosition end{};
    std::uint64_t steps = 0;  // at most, in one call
    std::uint64_t size = 0;   // numbers that its text computes, including those of the functions that it
                              // calls
};

using Declaration = std::variant<Structure, Constant, Function>;

/// One of the texts that a kernel is made of.
struct Source {
    std::string name{};  // its name in messages
    std::string text{};
};

struct Kernel {
    std::vector<Source> sources{};
    std::vector<Declaration> declarations{};
    std::vector<std::string> structures{};  // the names of all, by Type::structure; the prelude's come first
};

}  // namespace candela::kernel_language
