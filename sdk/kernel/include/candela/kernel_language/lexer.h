// Splits kernels, and any other C++ and GLSL, into names, numbers, signs, blanks and comments. It imports no
// module, because targets are plugins.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace candela::kernel_language {

/// A piece of a text. The lexemes of a text, one after another, are the text.
struct Lexeme {
    enum class Kind : std::uint8_t { blank, comment, name, integer, real, sign };
    Kind kind = Kind::sign;
    std::string_view text{};
    std::size_t offset = 0;

    bool is_skipped() const { return kind == Kind::blank || kind == Kind::comment; }
    bool is_word() const { return kind == Kind::name || kind == Kind::integer || kind == Kind::real; }
    std::size_t end() const { return offset + text.size(); }
};

/// All lexemes of a text, which they point into. Never fails: a sign is an operator of the kernel language
/// ("<=", "+=", "&&") or any other character; a comment that is not closed extends to the end. Regular
/// expressions would take an eighth of the time for writing a page, because libstdc++ needs a millisecond to
/// compile each.
std::vector<Lexeme> lexemes_of(std::string_view text);

/// The lexemes that mean something: not blanks or comments.
std::vector<Lexeme> code_of(std::string_view text);

/// The text of lexeme `i`; empty past the last.
std::string_view text_at(const std::vector<Lexeme>& lexemes, std::size_t i);

/// The text without comments; a blank stands for each /* */.
std::string without_comments(std::string_view text);

}  // namespace candela::kernel_language
