#include "tokens.h"

#include <algorithm>
#include <cstddef>

namespace candela::target {

namespace {

bool is_in_word(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

}  // namespace

bool Token::is_word() const { return is_in_word(text.front()); }

std::vector<Token> tokens_of(std::string_view code) {
    std::vector<Token> tokens;
    for (std::size_t i = 0; i < code.size();) {
        if (is_blank(code[i])) {
            ++i;
            continue;
        }
        const auto begin = code.begin() + static_cast<std::ptrdiff_t>(i);
        const auto end = is_in_word(code[i]) ? std::find_if_not(begin, code.end(), is_in_word) : begin + 1;
        tokens.push_back({std::string_view(begin, end), i == 0 || code[i - 1] == '\n'});
        i += tokens.back().text.size();
    }
    return tokens;
}

std::string_view text_at(const std::vector<Token>& tokens, std::size_t i) {
    return i < tokens.size() ? tokens[i].text : std::string_view();
}

}  // namespace candela::target
