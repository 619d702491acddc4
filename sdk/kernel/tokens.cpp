#include "tokens.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "candela/kernel_language/language.h"

import candela.util;

namespace candela::kernel_language {

namespace {

constexpr std::size_t k_longest_word = 100;  // bytes

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool begins_name(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

constexpr std::array<std::string_view, 13> k_pairs = {"==", "!=", "<=", ">=", "&&", "||", "++",
                                                      "--", "+=", "-=", "*=", "/=", "%="};
constexpr std::string_view k_signs = "+-*/%<>=!?:;,.(){}[]";

class Lexer {
  public:
    Lexer(std::string_view text, std::uint8_t source) : text_(text), source_(source) {}

    std::vector<Token> tokens() {
        for (skip(); at_ < text_.size(); skip()) {
            if (tokens_.size() >= k_most_tokens)
                refuse(at_, fmt::format("the text has more than {} words and signs", k_most_tokens));
            next();
        }
        take(Token::Kind::end, 0);
        return std::move(tokens_);
    }

  private:
    [[noreturn]] void refuse(std::size_t at, std::string message) const {
        throw Refusal{place(at), std::move(message)};
    }

    TextPosition place(std::size_t at) const { return {static_cast<std::uint32_t>(at), source_}; }

    char peek(std::size_t ahead = 0) const { return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0'; }

    void take(Token::Kind kind, std::size_t length) {
        tokens_.push_back({kind, text_.substr(at_, length), place(at_)});
        at_ += length;
    }

    /// Skips blanks and comments.
    void skip() {
        while (at_ < text_.size()) {
            if (is_space(text_[at_])) {
                refuse_line_end(at_);
                ++at_;
            } else if (text_.substr(at_).starts_with("//")) {
                comment(std::min(text_.find('\n', at_), text_.size()));
            } else if (text_.substr(at_).starts_with("/*")) {
                const std::size_t end = text_.find("*/", at_ + 2);
                if (end == std::string_view::npos) refuse(at_, "this comment is not closed");
                comment(end + 2);
            } else {
                return;
            }
        }
    }

    /// Skips a comment. The only error in a comment is a line that ends with a backslash: C++ joins it with
    /// the next before it looks for comments.
    void comment(std::size_t end) {
        for (; at_ < end; ++at_) {
            refuse_line_end(at_);
            const bool is_splice = text_[at_] == '\\' || text_.substr(at_, 3) ==
                                                             "?"
                                                             "?/";
            if (!is_splice) continue;
            const std::size_t length = text_[at_] == '\\' ? 1 : 3;
            const std::size_t next = text_.find_first_not_of(" \t\r\v\f", at_ + length);
            if (next == std::string_view::npos || text_[next] == '\n')
                refuse(at_, "a line of a comment must not end with '\\'");
        }
    }

    /// A carriage return alone ends a line for some compilers, but not for others.
    void refuse_line_end(std::size_t at) const {
        if (text_[at] == '\r' && (at + 1 >= text_.size() || text_[at + 1] != '\n'))
            refuse(at, R"(a line ends with \n, or with \r\n)");
    }

    void next() {
        const char c = peek();
        const std::string_view pair = text_.substr(at_, 2);
        if (begins_name(c)) return name();
        if (is_digit(c) || (c == '.' && is_digit(peek(1)))) return number();
        if (c == '#' || pair == "%:" ||
            pair ==
                "?"
                "?")
            refuse(at_, "the kernel language has no preprocessor");
        if (c == '"' || c == '\'') refuse(at_, "the kernel language has no strings");
        if (pair == "<:" || pair == ":>" || pair == "[[")
            refuse(at_, "the kernel language has neither arrays nor attributes");
        if (pair == "<%" || pair == "%>") refuse(at_, "write braces as { and }");
        if (pair == "::" || pair == "->" || pair == "<<" || pair == ">>")
            refuse(at_, fmt::format("the kernel language has no '{}'", pair));
        for (const std::string_view known : k_pairs)
            if (pair == known) return take(Token::Kind::sign, 2);
        if (c == '&')
            refuse(at_,
                   "the kernel language has neither pointers nor references, nor operators of bits; write "
                   "'and' as &&");
        if (k_signs.find(c) != std::string_view::npos) return take(Token::Kind::sign, 1);
        const std::string_view character = first_character(text_.substr(at_));
        refuse(at_, fmt::format("the kernel language has no '{}'", printable(character)));
    }

    void name() {
        std::size_t length = 1;
        while (begins_name(peek(length)) || is_digit(peek(length))) ++length;
        if (length > k_longest_word)
            refuse(at_, fmt::format("a name has at most {} characters", k_longest_word));
        take(Token::Kind::name, length);
    }

    std::size_t digits(std::size_t from) const {
        while (is_digit(peek(from))) ++from;
        return from;
    }

    /// "3", "0.5", ".5", "5.", "1e-6"; all except the first may end in f.
    void number() {
        std::size_t length = digits(0);
        bool is_real = false;
        if (peek(length) == '.') {
            length = digits(length + 1);
            is_real = true;
        }
        if (peek(length) == 'e' || peek(length) == 'E') {
            const std::size_t sign = peek(length + 1) == '+' || peek(length + 1) == '-' ? 1 : 0;
            if (is_digit(peek(length + 1 + sign))) {
                length = digits(length + 1 + sign);
                is_real = true;
            }
        }
        const std::string digits_only(text_.substr(at_, length));
        if (is_real && (peek(length) == 'f' || peek(length) == 'F')) ++length;
        if (begins_name(peek(length)) || is_digit(peek(length)) || peek(length) == '\'' ||
            peek(length) == '.')
            refuse(at_, "this is not a number of the kernel language; write it like 0.5 or 3");
        if (length > k_longest_word)
            refuse(at_, fmt::format("a number has at most {} characters", k_longest_word));
        if (is_real && !std::isfinite(std::strtof(digits_only.c_str(), nullptr)))
            refuse(at_, "this number is out of range: at most 3.4e38");
        if (!is_real && length > 1 && peek() == '0')
            refuse(at_, "an integer must not begin with 0, which would make it octal");
        if (!is_real && (length > 10 || std::strtoll(digits_only.c_str(), nullptr, 10) > 2147483647LL))
            refuse(at_, "this integer is out of range: at most 2147483647");
        take(is_real ? Token::Kind::real : Token::Kind::integer, length);
    }

    std::string_view text_;
    std::uint8_t source_;
    std::size_t at_ = 0;
    std::vector<Token> tokens_;
};

}  // namespace

std::vector<Token> tokens_of(std::string_view text, std::uint8_t source) {
    return Lexer(text, source).tokens();
}

}  // namespace candela::kernel_language
