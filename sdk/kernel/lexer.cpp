#include "candela/kernel_language/lexer.h"

#include <algorithm>
#include <array>

namespace candela::kernel_language {

namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool begins_name(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

constexpr std::array<std::string_view, 13> k_pairs = {"==", "!=", "<=", ">=", "&&", "||", "++",
                                                      "--", "+=", "-=", "*=", "/=", "%="};

class Lexer {
  public:
    explicit Lexer(std::string_view text) : text_(text) {}

    bool at_end() const { return at_ >= text_.size(); }

    Lexeme next() {
        using Kind = Lexeme::Kind;
        const std::string_view pair = text_.substr(at_, 2);
        if (is_blank(peek())) return take(Kind::blank, length_while(is_blank));
        if (pair == "//") return take(Kind::comment, text_.find('\n', at_) - at_);
        if (pair == "/*") return take(Kind::comment, length_to_comment_end());
        if (begins_name(peek()))
            return take(Kind::name, length_while([](char c) { return begins_name(c) || is_digit(c); }));
        if (is_digit(peek()) || (peek() == '.' && is_digit(peek(1)))) return number();
        return take(Kind::sign, std::ranges::find(k_pairs, pair) != k_pairs.end() ? 2 : 1);
    }

  private:
    char peek(std::size_t ahead = 0) const { return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0'; }

    Lexeme take(Lexeme::Kind kind, std::size_t length) {
        const Lexeme lexeme{kind, text_.substr(at_, length), at_};
        at_ = lexeme.end();
        return lexeme;
    }

    template <class Predicate>
    std::size_t length_while(Predicate is_part) const {
        const auto begin = text_.begin() + static_cast<std::ptrdiff_t>(at_);
        return static_cast<std::size_t>(std::find_if_not(begin, text_.end(), is_part) - begin);
    }

    std::size_t length_to_comment_end() const {
        const std::size_t end = text_.find("*/", at_ + 2);
        return end == std::string_view::npos ? end : end + 2 - at_;
    }

    std::size_t skip_digits(std::size_t from) const {
        while (is_digit(peek(from))) ++from;
        return from;
    }

    /// "3", "0.5", ".5", "5.", "1e-6"; all except the first may end in f.
    Lexeme number() {
        std::size_t length = skip_digits(0);
        bool is_real = false;
        if (peek(length) == '.') {
            length = skip_digits(length + 1);
            is_real = true;
        }
        if (peek(length) == 'e' || peek(length) == 'E') {
            const std::size_t sign = peek(length + 1) == '+' || peek(length + 1) == '-' ? 1 : 0;
            if (is_digit(peek(length + 1 + sign))) {
                length = skip_digits(length + 1 + sign);
                is_real = true;
            }
        }
        if (is_real && (peek(length) == 'f' || peek(length) == 'F')) ++length;
        return take(is_real ? Lexeme::Kind::real : Lexeme::Kind::integer, length);
    }

    std::string_view text_;
    std::size_t at_ = 0;
};

}  // namespace

std::vector<Lexeme> lexemes_of(std::string_view text) {
    std::vector<Lexeme> lexemes;
    for (Lexer lexer(text); !lexer.at_end();) lexemes.push_back(lexer.next());
    return lexemes;
}

std::vector<Lexeme> code_of(std::string_view text) {
    std::vector<Lexeme> lexemes;
    for (Lexer lexer(text); !lexer.at_end();) {
        const Lexeme lexeme = lexer.next();
        if (!lexeme.is_skipped()) lexemes.push_back(lexeme);
    }
    return lexemes;
}

std::string_view text_at(const std::vector<Lexeme>& lexemes, std::size_t i) {
    return i < lexemes.size() ? lexemes[i].text : std::string_view();
}

std::string without_comments(std::string_view text) {
    std::string result;
    for (Lexer lexer(text); !lexer.at_end();) {
        const Lexeme lexeme = lexer.next();
        if (lexeme.kind != Lexeme::Kind::comment) {
            result += lexeme.text;
        } else if (lexeme.text.starts_with("/*")) {
            result += ' ';
        }
    }
    return result;
}

}  // namespace candela::kernel_language
