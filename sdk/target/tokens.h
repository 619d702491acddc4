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

/// Those of `code`, which has no comments and which they point into. With regular expressions, of which
/// libstdc++ compiles one in a millisecond, this took an eighth of the time that a page takes.
std::vector<Token> tokens_of(std::string_view code);

/// What one of them is; nothing beyond the last.
std::string_view text_at(const std::vector<Token>& tokens, std::size_t i);

}  // namespace candela::target
