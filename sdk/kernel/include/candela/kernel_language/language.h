// The kernel language, for texts that nobody trusts: a text is parsed and checked, and what was understood is
// what gets compiled. docs/kernel-language.md has the grammar.
#pragma once

#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "candela/kernel_language/syntax.h"

namespace candela::kernel_language {

inline constexpr std::size_t k_longest_text = 200'000;  // bytes, of a kernel
inline constexpr std::size_t k_longest_body = 20'000;   // bytes, of a function's body on its own
inline constexpr std::size_t k_most_tokens = 50'000;
inline constexpr std::size_t k_deepest_nesting = 64;         // of brackets and statements
inline constexpr std::size_t k_deepest_expression = 256;     // operations that depend on one another
inline constexpr std::uint64_t k_most_iterations = 100'000;  // of a loop, times those around it
inline constexpr std::uint64_t k_most_steps = 1'000'000;     // of one call, with the calls that it makes
inline constexpr std::uint64_t k_largest_size = 30'000;      // of a function: numbers computed, with calls
inline constexpr std::uint64_t k_largest_struct = 1'000;     // numbers

/// What is not in the language, and where. Lines and columns count from 1, columns in characters.
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

/// The body of one function, in place of the one that a kernel has.
struct Body {
    std::string function;  // "phong_reflect"
    Source source;
};

/// Reads a kernel, and replaces a function's body. A function without side effects, without access to memory,
/// that ends after a bounded number of steps: nothing else gets through. Throws Problem; where the kernel
/// has no such function, std::invalid_argument.
Kernel read_kernel(const Source& kernel, const std::optional<Body>& body = std::nullopt);

/// What a kernel's text is written as.
enum class Emission : std::uint8_t {
    kernel,  ///< the kernel language again, which is C++ and GLSL
    /// C++ for the inside of `namespace candela::kernel`, after "candela/kernel.h": the same values, and
    /// defined ones also where the language leaves a value open, such as for a quotient by zero. To be
    /// compiled with -fwrapv.
    guarded_cpp
};

/// The text of what was read: nothing of the original but names and numbers. Lines stay where they were, as
/// far as possible columns, too.
std::string emitted(const Kernel& kernel, Emission emission);

}  // namespace candela::kernel_language
