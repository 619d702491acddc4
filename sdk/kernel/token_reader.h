// Reads tokens one after another, and reports syntax errors.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tokens.h"

namespace candela::kernel_language {

class TokenReader {
  public:
    explicit TokenReader(const std::vector<Token>& tokens) : tokens_(tokens) {}

    const Token& peek(std::size_t ahead = 0) const;
    bool is(std::string_view text) const;
    bool at_end() const { return peek().kind == Token::Kind::end; }
    const Token& take();
    /// Reads the next token if it has this text; returns whether it does.
    bool skip(std::string_view text);
    /// Reads a token with this text; otherwise refuses what is there, naming what else is `wanted`, such as
    /// "an operator or ".
    const Token& expect(std::string_view text, std::string_view wanted = {});
    /// Reads the bracket that closes `open`.
    const Token& expect_closing(const Token& open);
    /// Reads a name for something that is declared.
    const Token& expect_new_name(std::string_view what);
    /// Reads any name except a keyword of C++.
    const Token& expect_name(std::string_view what);

    [[noreturn]] static void refuse(const Token& token, std::string message);
    /// "expected ';', got 'x'".
    [[noreturn]] void refuse_next(const std::string& expected) const;

    /// One level of nesting while it exists. Refuses levels that are too deep.
    class Level {
      public:
        explicit Level(TokenReader& reader);
        Level(const Level&) = delete;
        Level& operator=(const Level&) = delete;
        ~Level() { --reader_.depth_; }

      private:
        TokenReader& reader_;
    };

  private:
    const std::vector<Token>& tokens_;
    std::size_t at_ = 0;
    std::size_t depth_ = 0;
};

/// Parses an expression, up to the first token that does not belong to it.
Expression parsed_expression(TokenReader& tokens);

}  // namespace candela::kernel_language
