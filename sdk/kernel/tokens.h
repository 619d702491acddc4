// The tokens of the kernel language.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "candela/kernel_language/syntax.h"

namespace candela::kernel_language {

struct Token {
    enum class Kind : std::uint8_t { name, integer, real, sign, end };
    Kind kind = Kind::end;
    std::string_view text;
    TextPosition place{};
};

/// A problem at a position; becomes a Problem where the texts are known.
struct Refusal {
    TextPosition place;
    std::string message;
};

/// The tokens of `text`, followed by an `end`. Throws Refusal.
std::vector<Token> tokens_of(std::string_view text, std::uint8_t source);

/// Why a name cannot be one of a kernel's, or of the prelude's that it uses; empty if it can.
std::string problem_with_name(std::string_view name);

/// Why a kernel must not declare this name, which C++ or GLSL reserves; empty if it may.
std::string problem_with_new_name(std::string_view name);

/// Whether GLSL has a function of that name, which the kernel language does not have.
bool is_glsl_function(std::string_view name);

/// Whether the word is reserved by C++ or by the language itself.
bool is_keyword(std::string_view word);

/// "the kernel language has no 'while'; …", with the alternative.
std::string refusal_of_keyword(std::string_view word);

}  // namespace candela::kernel_language
