#include "kernel_language.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

import candela.text;

namespace {

constexpr std::size_t k_longest_body = 20000;  // bytes
constexpr std::size_t k_deepest = 64;          // brackets in one another

/// Keywords that both languages have and that compute.
constexpr std::array<std::string_view, 14> k_keywords = {"if",     "else",  "for",      "while", "do",
                                                         "return", "break", "continue", "const", "float",
                                                         "int",    "bool",  "true",     "false"};

/// The other keywords of C++20, GNU's among them that do not begin with "_".
constexpr std::array<std::string_view, 80> k_foreign = {
    "alignas",     "alignof",   "and",        "and_eq",   "asm",          "auto",
    "bitand",      "bitor",     "case",       "catch",    "char",         "char8_t",
    "char16_t",    "char32_t",  "class",      "compl",    "concept",      "consteval",
    "constexpr",   "constinit", "const_cast", "co_await", "co_return",    "co_yield",
    "decltype",    "default",   "delete",     "double",   "dynamic_cast", "enum",
    "explicit",    "export",    "extern",     "friend",   "goto",         "import",
    "inline",      "long",      "module",     "mutable",  "namespace",    "new",
    "noexcept",    "not",       "not_eq",     "nullptr",  "operator",     "or",
    "or_eq",       "private",   "protected",  "public",   "register",     "reinterpret_cast",
    "requires",    "short",     "signed",     "sizeof",   "static",       "static_assert",
    "static_cast", "struct",    "switch",     "template", "this",         "thread_local",
    "throw",       "try",       "typedef",    "typeid",   "typename",     "typeof",
    "union",       "unsigned",  "using",      "virtual",  "void",         "volatile",
    "wchar_t",     "xor"};

constexpr std::array<std::string_view, 5> k_types = {"float", "int", "bool", "const", "void"};

bool is_one_of(std::string_view word, const auto& words) {
    return std::ranges::find(words, word) != words.end();
}
bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool begins_name(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

/// With comments as spaces, so that what follows stays where it is.
std::string without_comments(std::string_view text) {
    std::string result(text);
    for (std::size_t i = 0; i + 1 < result.size(); ++i) {
        if (result[i] != '/' || (result[i + 1] != '/' && result[i + 1] != '*')) continue;
        const bool is_line = result[i + 1] == '/';
        std::size_t end = text.find(is_line ? "\n" : "*/", i + 2);
        end = end == std::string_view::npos ? result.size() : end + (is_line ? 0 : 2);
        for (; i < end; ++i)
            if (result[i] != '\n') result[i] = ' ';
        --i;
    }
    return result;
}

struct Token {
    enum class Kind { name, number, sign };
    Kind kind = Kind::sign;
    std::string_view text;
    std::size_t at = 0;
};

/// Signs of two characters that the language has; "::", "->", "[[", "<:" and the like are not among them.
constexpr std::array<std::string_view, 12> k_pairs = {"==", "!=", "<=", ">=", "&&", "||",
                                                      "++", "--", "+=", "-=", "*=", "/="};
constexpr std::string_view k_signs = "+-*/%<>=!?:;,.(){}&|^~";

/// A number as C++ and GLSL both write it, from `at` on; its end.
std::size_t end_of_number(std::string_view text, std::size_t at) {
    const auto digits = [&] {
        while (at < text.size() && is_digit(text[at])) ++at;
    };
    digits();
    if (at < text.size() && text[at] == '.') {
        ++at;
        digits();
    }
    if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
        std::size_t exponent = at + 1;
        if (exponent < text.size() && (text[exponent] == '+' || text[exponent] == '-')) ++exponent;
        if (exponent < text.size() && is_digit(text[exponent])) {
            at = exponent;
            digits();
        }
    }
    if (at < text.size() && (text[at] == 'f' || text[at] == 'F')) ++at;
    return at;
}

KernelLanguageProblem problem_at(std::string_view text, std::size_t at, std::string message) {
    const std::string_view before = text.substr(0, at);
    const std::size_t begin = before.rfind('\n');
    return {.line = 1 + static_cast<std::size_t>(std::ranges::count(before, '\n')),
            .column = 1 + candela::character_count(
                              begin == std::string_view::npos ? before : before.substr(begin + 1)),
            .message = std::move(message)};
}

/// Tokens, up to the first that the language does not have.
std::optional<KernelLanguageProblem> read_tokens(std::string_view text, std::vector<Token>& tokens) {
    for (std::size_t i = 0; i < text.size();) {
        const char c = text[i];
        if (is_space(c)) {
            ++i;
            continue;
        }
        const std::size_t begin = i;
        if (begins_name(c)) {
            while (i < text.size() && (begins_name(text[i]) || is_digit(text[i]))) ++i;
            tokens.push_back({Token::Kind::name, text.substr(begin, i - begin), begin});
            continue;
        }
        if (is_digit(c) || (c == '.' && i + 1 < text.size() && is_digit(text[i + 1]))) {
            i = end_of_number(text, i);
            if (i < text.size() && (begins_name(text[i]) || is_digit(text[i]) || text[i] == '\''))
                return problem_at(text, begin,
                                  "this is no number of the kernel language; write it as in 0.5 or 3");
            tokens.push_back({Token::Kind::number, text.substr(begin, i - begin), begin});
            continue;
        }
        const std::string_view pair = text.substr(i, 2);
        if (c == '#' || pair == "%:" || pair == "??")
            return problem_at(text, i, "the kernel language has no preprocessor here");
        if (c == '"' || c == '\'') return problem_at(text, i, "the kernel language has no texts");
        if (c == '[' || c == ']' || pair == "<:" || pair == ":>")
            return problem_at(text, i,
                              "the kernel language has neither arrays nor attributes; a vector's components "
                              "are v.x, v.y, v.z");
        if (pair == "<%" || pair == "%>") return problem_at(text, i, "braces are written { and }");
        if (pair == "::" || pair == "->")
            return problem_at(text, i, fmt::format("the kernel language has no '{}'", pair));
        if (is_one_of(pair, k_pairs)) {
            tokens.push_back({Token::Kind::sign, pair, i});
            i += 2;
            continue;
        }
        if (k_signs.find(c) == std::string_view::npos) {
            const std::string_view character = candela::first_character(text.substr(i));
            return problem_at(text, i,
                              fmt::format("the kernel language has no '{}'", candela::printable(character)));
        }
        tokens.push_back({Token::Kind::sign, text.substr(i, 1), i});
        ++i;
    }
    return std::nullopt;
}

std::optional<std::string> problem_with_name(std::string_view name) {
    if (is_one_of(name, k_keywords)) return std::nullopt;
    if (is_one_of(name, k_foreign)) return fmt::format("the kernel language has no '{}'", name);
    if (name.starts_with("_") || name.find("__") != std::string_view::npos || name == "KERNEL" ||
        name.starts_with("CANDELA"))
        return fmt::format("'{}' is a reserved name; choose another", candela::shortened(name));
    return std::nullopt;
}

/// Whether an operator that follows this token has no operand before it.
bool precedes_operand(const Token& token) {
    if (token.kind == Token::Kind::sign) return token.text != ")" && token.text != "++" && token.text != "--";
    return token.kind == Token::Kind::name && (token.text == "return" || is_one_of(token.text, k_types));
}

}  // namespace

std::optional<KernelLanguageProblem> problem_in_body(std::string_view body) {
    if (body.size() > k_longest_body)
        return KernelLanguageProblem{
            1, 1, fmt::format("the text has {} bytes; {} are allowed", body.size(), k_longest_body)};
    const std::string text = without_comments(body);
    std::vector<Token> tokens;
    if (auto problem = read_tokens(text, tokens)) return problem;
    std::vector<Token> open;
    for (std::size_t i = 0; i < tokens.size(); ++i) {
        const Token& token = tokens[i];
        const std::string_view sign = token.kind == Token::Kind::sign ? token.text : "";
        if (token.kind == Token::Kind::name) {
            if (auto problem = problem_with_name(token.text))
                return problem_at(text, token.at, *std::move(problem));
        }
        if (sign == "(" || sign == "{") open.push_back(token);
        if (open.size() > k_deepest)
            return problem_at(text, token.at,
                              fmt::format("brackets are nested more than {} deep", k_deepest));
        if (sign == ")" || sign == "}") {
            if (open.empty() || open.back().text != (sign == ")" ? "(" : "{"))
                return problem_at(text, token.at, fmt::format("this '{}' closes nothing", sign));
            open.pop_back();
        }
        // Addresses, pointers, references, and what they are declared with.
        const bool is_prefix = i == 0 || precedes_operand(tokens[i - 1]);
        if (is_prefix && (sign == "*" || sign == "&" || sign == "&&"))
            return problem_at(text, token.at, "the kernel language has neither pointers nor references");
        if (sign == "*" && i + 1 < tokens.size() &&
            (tokens[i + 1].text == "*" || tokens[i + 1].text == ")" || tokens[i + 1].text == ","))
            return problem_at(text, token.at, "the kernel language has neither pointers nor references");
    }
    if (std::ranges::none_of(tokens, [](const Token& token) { return token.text == "return"; }))
        return problem_at(text, text.size(), "nothing is returned");
    if (!open.empty())
        return problem_at(text, open.back().at, fmt::format("this '{}' is not closed", open.back().text));
    return std::nullopt;
}

std::string body_for_cpp(std::string_view body) {
    const std::string text = without_comments(body);
    std::vector<Token> tokens;
    static_cast<void>(read_tokens(text, tokens));
    std::string result;
    std::size_t copied = 0;
    for (const Token& token : tokens) {
        if (token.kind != Token::Kind::number || token.text.find_first_of(".eE") == std::string_view::npos ||
            token.text.ends_with('f') || token.text.ends_with('F'))
            continue;
        const std::size_t end = token.at + token.text.size();
        result += text.substr(copied, end - copied) + "f";
        copied = end;
    }
    return result + text.substr(copied);
}
