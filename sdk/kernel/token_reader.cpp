#include "token_reader.h"

#include <fmt/format.h>

#include <algorithm>

#include "candela/kernel_language/language.h"

import candela.util;

namespace candela::kernel_language {

const Token& TokenReader::peek(std::size_t ahead) const {
    return tokens_[std::min(at_ + ahead, tokens_.size() - 1)];
}

bool TokenReader::is(std::string_view text) const {
    const Token& token = peek();
    return token.kind != Token::Kind::end && token.text == text;
}

const Token& TokenReader::take() {
    const Token& token = peek();
    at_ = std::min(at_ + 1, tokens_.size() - 1);
    return token;
}

bool TokenReader::skip(std::string_view text) {
    if (!is(text)) return false;
    take();
    return true;
}

const Token& TokenReader::expect(std::string_view text, std::string_view wanted) {
    if (is(text)) return take();
    refuse_next(fmt::format("{}'{}'", wanted, text));
}

const Token& TokenReader::expect_closing(const Token& open) {
    const std::string_view closing = open.text == "(" ? ")" : open.text == "[" ? "]" : "}";
    if (is(closing)) return take();
    if (at_end()) refuse(open, fmt::format("this '{}' is not closed", open.text));
    refuse_next(fmt::format("{}'{}'", open.text == "{" ? "" : "an operator or ", closing));
}

const Token& TokenReader::expect_name(std::string_view what) {
    if (peek().kind != Token::Kind::name) refuse_next(std::string(what));
    if (const std::string problem = problem_with_name(peek().text); !problem.empty()) refuse(peek(), problem);
    return take();
}

const Token& TokenReader::expect_new_name(std::string_view what) {
    if (is("*") || is("&&")) refuse(peek(), "the kernel language has neither pointers nor references");
    const Token& name = expect_name(what);
    if (const std::string problem = problem_with_new_name(name.text); !problem.empty()) refuse(name, problem);
    return name;
}

void TokenReader::refuse(const Token& token, std::string message) {
    throw Refusal{token.place, std::move(message)};
}

void TokenReader::refuse_next(const std::string& expected) const {
    const Token& token = peek();
    if (token.kind == Token::Kind::name && problem_with_name(token.text).find("has no") != std::string::npos)
        refuse(token, problem_with_name(token.text));
    if (token.text == "[") refuse(token, "the kernel language has neither arrays nor attributes");
    if (token.text == "=" && expected.starts_with("an operator") && !expected.ends_with("';'"))
        refuse(token, "an assignment is a statement of its own; compare numbers with ==");
    if (token.text == ",")
        refuse(token, fmt::format("expected {}; the kernel language has no operator ','", expected));
    if (token.text == "++" || token.text == "--")
        refuse(token, fmt::format("'{0}' is a statement of its own, such as {0}i;", token.text));
    const std::string message = token.kind == Token::Kind::end
                                    ? fmt::format("expected {} before the end", expected)
                                    : fmt::format("expected {} before '{}'", expected, shortened(token.text));
    // If something is missing at the end of a line, the message points there, not to the beginning of the
    // next line.
    if (at_ > 0) {
        const std::string_view last = tokens_[at_ - 1].text;
        // Both are views of one text.
        if (std::find(last.end(), token.text.begin(), '\n') != token.text.begin()) {
            TextPosition end = tokens_[at_ - 1].place;
            end.offset += static_cast<std::uint32_t>(last.size());
            throw Refusal{end, message};
        }
    }
    refuse(token, message);
}

TokenReader::Level::Level(TokenReader& reader) : reader_(reader) {
    // Counts first, so that nothing continues to parse after a refusal.
    if (++reader_.depth_ > k_deepest_nesting)
        refuse(reader_.peek(),
               fmt::format("brackets and statements are nested more than {} deep", k_deepest_nesting));
}

}  // namespace candela::kernel_language
