// The words of the kernel language.
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
    Place place{};
};

/// What is wrong at a place; becomes a Problem where the texts are known.
struct Refusal {
    Place place;
    std::string message;
};

/// The tokens of `text`, an `end` last. Throws Refusal.
std::vector<Token> tokens_of(std::string_view text, std::uint8_t source);

/// What may not be the name of anything a kernel declares, and why; empty if it may.
std::string problem_with_name(std::string_view name);

/// Whether C++ or the language itself has a word for itself.
bool is_keyword(std::string_view word);

/// "the kernel language has no 'while'; …", with what it has instead.
std::string refusal_of_keyword(std::string_view word);

}  // namespace candela::kernel_language
