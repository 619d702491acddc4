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

/// Why a kernel must not declare this name; empty if it may.
std::string problem_with_name(std::string_view name);

/// Whether the word is reserved by C++ or by the language itself.
bool is_keyword(std::string_view word);

/// "the kernel language has no 'while'; …", with the alternative.
std::string refusal_of_keyword(std::string_view word);

}  // namespace candela::kernel_language
