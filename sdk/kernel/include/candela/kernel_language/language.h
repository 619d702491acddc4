// The kernel language, for untrusted texts: a text is parsed and checked, and only what was understood is
// compiled. docs/plugins/kernel-language.md has the grammar.
#pragma once

#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "candela/kernel_language/syntax.h"

namespace candela::kernel_language {

inline constexpr std::size_t k_longest_text = 200'000;  // bytes, of a kernel
inline constexpr std::size_t k_longest_body = 20'000;   // bytes, of a single function's body
inline constexpr std::size_t k_most_tokens = 50'000;
inline constexpr std::size_t k_deepest_nesting = 64;         // of brackets and statements
inline constexpr std::size_t k_deepest_expression = 256;     // operations that depend on one another
inline constexpr std::uint64_t k_most_iterations = 100'000;  // of a loop, multiplied by those of the loops
                                                             // around it
inline constexpr std::uint64_t k_most_steps = 1'000'000;     // of one call, including the calls that it makes
inline constexpr std::uint64_t k_largest_size = 30'000;      // of a function: numbers computed, including
                                                             // calls
inline constexpr std::uint64_t k_largest_struct = 1'000;     // numbers

/// A part of a text that is not in the language, and its position. Lines and columns count from 1, columns in
/// characters.
class Problem : public std::runtime_error {
  public:
    Problem(std::string file, std::size_t line, std::size_t column, const std::string& message)
        : std::runtime_error(message), file_(std::move(file)), line_(line), column_(column) {}
    const std::string& file() const { return file_; }
    std::size_t line() const { return line_; }
    std::size_t column() const { return column_; }
    /// "phong.kernel:3:7: unknown variable 'n'".
    std::string text() const;

  private:
    std::string file_;
    std::size_t line_, column_;
};

/// The body of one function, to replace the one in a kernel.
struct Body {
    std::string function;  // "phong_reflect"
    Source source;
};

/// Reads a kernel, and replaces a function's body. Accepts only functions that have no side effects, do not
/// access memory and end after a bounded number of steps. Throws Problem, or std::invalid_argument if the
/// kernel has no such function.
Kernel read_kernel(const Source& kernel, const std::optional<Body>& body = std::nullopt);

/// The language in which a kernel is emitted.
enum class Emission : std::uint8_t {
    kernel,  ///< the kernel language again, which is C++ and GLSL
    /// C++ for the inside of `namespace candela::kernel`, after "candela/kernel/kernel.h": computes the same
    /// values, and defined ones even if the language leaves a value open, such as a quotient by zero. Compile
    /// it with -fwrapv.
    guarded_cpp
};

/// Emits what was read: only names and numbers come from the original. Lines are preserved and, as far as
/// possible, columns.
std::string emitted(const Kernel& kernel, Emission emission);

}  // namespace candela::kernel_language
