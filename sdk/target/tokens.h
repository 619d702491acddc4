// Texts of kernels and of the libraries that they need, word by word.
#pragma once

#include <string_view>
#include <vector>

namespace candela::target {

/// A name or a number, or one character of anything else that is not a blank.
struct Token {
    std::string_view text;
    bool begins_line = false;

    bool is_word() const;
};

/// The tokens of `code`, which has no comments; they point into it. Regular expressions, of which libstdc++
/// compiles one per millisecond, would take an eighth of the time for writing a page.
std::vector<Token> tokens_of(std::string_view code);

/// The text of token `i`; empty past the last.
std::string_view text_at(const std::vector<Token>& tokens, std::size_t i);

}  // namespace candela::target
