// Types, names, bounds: what a parsed kernel means, and whether that is allowed.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "builtins.h"
#include "candela/kernel_language/syntax.h"
#include "tokens.h"

namespace candela::kernel_language {

/// The declarations of a kernel, for itself and for the kernels that follow it.
struct Declared {
    struct Callable {
        Signature signature;
        std::uint64_t steps = 0, size = 0;
    };
    std::vector<Structure> structures;
    std::map<std::string, Callable, std::less<>> functions;
};

/// A variable or a constant in scope.
struct Seen {
    Type type;
    bool is_constant = false;
    bool counts_a_loop = false;
    std::optional<std::int64_t> value{};  // of an integer that is known at compile time
};

class Checker {
  public:
    /// For a kernel that can use what `prelude` declares.
    explicit Checker(Declared prelude) : declared_(std::move(prelude)) {}

    /// Fills in types, conversions and costs. Throws Refusal.
    void check(std::vector<Declaration>& declarations);
    const Declared& declared() const { return declared_; }

  private:
    // checker.cpp
    void structure(Structure& structure);
    void constant(Constant& constant);
    void function(Function& function);
    void require_new_name(const std::string& name, TextPosition place);
    void resolve(TypeName& type) const;
    std::string text_of(Type type) const;
    std::uint64_t numbers_in(Type type) const;
    std::vector<std::string> known_types() const;
    void see(const std::string& name, TextPosition place, Seen seen, bool is_assigned);
    const std::size_t* seen_as(std::string_view name) const;
    void open_scope() { scopes_.emplace_back(); }
    void close_scope();
    void count(std::uint64_t steps, std::uint64_t size, TextPosition place);

    // checker_statements.cpp
    void statements(std::vector<Statement>& all);
    void statement(Statement& statement);
    void declare(Statement& statement);
    void assign(Statement& statement);
    void branch(Statement& statement);
    void loop(Statement& statement);
    std::uint64_t iterations_of(const Statement& loop) const;
    void in_scope(Statement& block);

    // checker_expressions.cpp
    Type check(Expression& expression);
    void check_as(Expression& expression, Type wanted, std::string_view what);
    Type unary(Expression& expression);
    Type binary(Expression& expression);
    Type member(Expression& expression);
    Type swizzle(const Expression& expression, Type of) const;
    Type index(Expression& expression);
    Type call(Expression& expression);
    Type conditional(Expression& expression);
    Type variable(const Expression& expression) const;
    [[noreturn]] void refuse_unknown(const Expression& variable) const;
    const Signature* fitting(const Expression& call, const std::vector<Signature>& overloads) const;
    Type called(Expression& call, const std::vector<Signature>& overloads);
    std::optional<std::int64_t> value_of(const Expression& expression) const;
    bool is_constant(const Expression& expression) const;

    Declared declared_;
    std::map<std::string, TextPosition, std::less<>> functions_to_come_;
    Type result_{};
    std::string function_;  // the function being checked
    std::vector<Seen> seen_;
    std::vector<bool> assigned_;  // for each variable
    std::map<std::string, std::vector<std::size_t>, std::less<>> visible_;
    std::vector<std::set<std::string>> scopes_;
    std::string being_declared_;
    bool is_reachable_ = true;
    int loops_ = 0;
    std::uint64_t iterations_ = 1;
    std::uint64_t steps_ = 0, size_ = 0;
};

/// Whether an expression of this type yields a vector that C++ constructs only on conversion.
bool is_swizzle(const Expression& expression);

}  // namespace candela::kernel_language
