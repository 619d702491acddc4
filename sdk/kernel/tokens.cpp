#include "tokens.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <utility>

#include "builtins.h"
#include "candela/kernel_language/language.h"
#include "candela/kernel_language/lexer.h"

import candela.util;

namespace candela::kernel_language {

namespace {

constexpr std::size_t k_longest_word = 100;  // bytes

constexpr std::string_view k_signs = "+-*/%<>=!?:;,.(){}[]";

/// Refuses what other C++ and GLSL may contain, but the kernel language does not.
class TokenChecker {
  public:
    TokenChecker(std::string_view text, std::uint8_t source) : text_(text), source_(source) {}

    std::vector<Token> tokens() {
        if (text_.starts_with("\xef\xbb\xbf"))
            refuse(0,
                   "the text begins with a byte order mark, which shaders do not take; save it as UTF-8 "
                   "without one");
        for (const Lexeme& lexeme : lexemes_of(text_)) add(lexeme);
        take(Token::Kind::end, {.text = {}, .offset = text_.size()});
        return std::move(tokens_);
    }

  private:
    [[noreturn]] void refuse(std::size_t at, std::string message) const {
        throw Refusal{place(at), std::move(message)};
    }

    TextPosition place(std::size_t at) const { return {static_cast<std::uint32_t>(at), source_}; }

    char peek(std::size_t at) const { return at < text_.size() ? text_[at] : '\0'; }

    void take(Token::Kind kind, const Lexeme& lexeme) {
        tokens_.push_back({kind, lexeme.text, place(lexeme.offset)});
    }

    void add(const Lexeme& lexeme) {
        if (lexeme.kind == Lexeme::Kind::blank) return check_blank(lexeme);
        if (lexeme.kind == Lexeme::Kind::comment) return check_comment(lexeme);
        if (tokens_.size() >= k_most_tokens)
            refuse(lexeme.offset, fmt::format("the text has more than {} words and signs", k_most_tokens));
        if (lexeme.kind == Lexeme::Kind::name) return name(lexeme);
        if (lexeme.is_word()) return number(lexeme);
        sign(lexeme);
    }

    void check_blank(const Lexeme& blank) const {
        for (std::size_t at = blank.offset; at < blank.end(); ++at) {
            refuse_line_end(at);
            if (text_[at] == '\v' || text_[at] == '\f') refuse_character(at);
        }
    }

    /// Apart from the end, the only error in a comment is a line that ends with a backslash: C++ joins it
    /// with the next before it looks for comments.
    void check_comment(const Lexeme& comment) const {
        const bool is_open =
            comment.text.starts_with("/*") && (comment.text.size() < 4 || !comment.text.ends_with("*/"));
        if (is_open) refuse(comment.offset, "this comment is not closed");
        for (std::size_t at = comment.offset; at < comment.end(); ++at) {
            refuse_line_end(at);
            const bool is_splice = text_[at] == '\\' || text_.substr(at, 3) ==
                                                            "?"
                                                            "?/";
            if (!is_splice) continue;
            const std::size_t length = text_[at] == '\\' ? 1 : 3;
            const std::size_t next = text_.find_first_not_of(" \t\r\v\f", at + length);
            if (next == std::string_view::npos || text_[next] == '\n')
                refuse(at, "a line of a comment must not end with '\\'");
        }
    }

    /// A carriage return alone ends a line for some compilers, but not for others.
    void refuse_line_end(std::size_t at) const {
        if (text_[at] == '\r' && peek(at + 1) != '\n') refuse(at, R"(a line ends with \n, or with \r\n)");
    }

    [[noreturn]] void refuse_character(std::size_t at) const {
        const std::string_view character = first_character(text_.substr(at));
        refuse(at, fmt::format("the kernel language has no '{}'", printable(character)));
    }

    /// A string is usually the argument of a function that does not exist either, which says more:
    /// fopen("…").
    [[noreturn]] void refuse_string(std::size_t at) const {
        int open = 0;
        for (std::size_t i = tokens_.size(); i-- > 1;) {
            const std::string_view text = tokens_[i].text;
            if (text == ";" || text == "{" || text == "}") break;
            if (text == ")") --open;
            if (text != "(" || ++open <= 0) continue;
            const Token& called = tokens_[i - 1];
            if (called.kind != Token::Kind::name || is_function(called.text)) break;
            throw Refusal{called.place,
                          fmt::format("unknown function '{}', and the kernel language has no strings",
                                      shortened(called.text))};
        }
        refuse(at, "the kernel language has no strings");
    }

    /// Whether it is a function of the language, or one declared so far.
    bool is_function(std::string_view name) const {
        for (std::size_t i = 2; i < tokens_.size(); ++i)
            if (tokens_[i].text == name && tokens_[i - 2].text == "KERNEL") return true;
        return is_keyword(name) || builtin_functions().contains(name) || builtin_type(name);
    }

    void sign(const Lexeme& sign) {
        const std::size_t at = sign.offset;
        const char c = text_[at];
        const std::string_view pair = text_.substr(at, 2);
        if (c == '#' || pair == "%:" ||
            pair ==
                "?"
                "?")
            refuse(at, "the kernel language has no preprocessor");
        if (c == '"' || c == '\'') refuse_string(at);
        if (pair == "<:" || pair == ":>" || pair == "[[")
            refuse(at, "the kernel language has neither arrays nor attributes");
        if (pair == "<%" || pair == "%>") refuse(at, "write braces as { and }");
        if (pair == "::" || pair == "->" || pair == "<<" || pair == ">>")
            refuse(at, fmt::format("the kernel language has no '{}'", pair));
        if (sign.text == "&")
            refuse(at,
                   "the kernel language has neither pointers nor references, nor operators of bits; write "
                   "'and' as &&");
        if (sign.text.size() == 1 && k_signs.find(c) == std::string_view::npos) refuse_character(at);
        take(Token::Kind::sign, sign);
    }

    void name(const Lexeme& name) {
        if (name.text.size() > k_longest_word)
            refuse(name.offset, fmt::format("a name has at most {} characters", k_longest_word));
        take(Token::Kind::name, name);
    }

    void number(const Lexeme& number) {
        const std::size_t at = number.offset, length = number.text.size();
        const bool is_real = number.kind == Lexeme::Kind::real;
        const std::string digits(number.text);  // strtof() stops at an f
        const char next = peek(number.end());
        if ((next >= 'a' && next <= 'z') || (next >= 'A' && next <= 'Z') || (next >= '0' && next <= '9') ||
            next == '_' || next == '\'' || next == '.')
            refuse(at, "this is not a number of the kernel language; write it like 0.5 or 3");
        if (length > k_longest_word)
            refuse(at, fmt::format("a number has at most {} characters", k_longest_word));
        if (is_real && !std::isfinite(std::strtof(digits.c_str(), nullptr)))
            refuse(at, "this number is out of range: at most 3.4e38");
        if (!is_real && length > 1 && number.text.front() == '0')
            refuse(at, "an integer must not begin with 0, which would make it octal");
        if (!is_real && (length > 10 || std::strtoll(digits.c_str(), nullptr, 10) > 2147483647LL))
            refuse(at, "this integer is out of range: at most 2147483647");
        take(is_real ? Token::Kind::real : Token::Kind::integer, number);
    }

    std::string_view text_;
    std::uint8_t source_;
    std::vector<Token> tokens_;
};

}  // namespace

std::vector<Token> tokens_of(std::string_view text, std::uint8_t source) {
    return TokenChecker(text, source).tokens();
}

}  // namespace candela::kernel_language
