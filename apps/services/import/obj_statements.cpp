#include "import/obj_statements.h"

#include <cctype>
#include <charconv>
#include <cmath>

namespace importing::obj {

std::string_view trimmed(std::string_view text) {
    const auto is_blank = [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v'; };
    while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
    return text;
}

std::string_view word_from(std::string_view& rest) {
    rest = trimmed(rest);
    const std::string_view word = rest.substr(0, rest.find_first_of(" \t\f\v"));
    rest = trimmed(rest.substr(word.size()));
    return word;
}

std::string name_from(std::string_view rest) {
    std::string name;
    for (std::string_view word = word_from(rest); !word.empty(); word = word_from(rest))
        name.append(name.empty() ? "" : " ").append(word);
    return name;
}

std::string_view without_comment(std::string_view name) { return name.substr(0, name.find(" #")); }

std::vector<double> numbers_from(std::string_view rest) {
    std::vector<double> numbers;
    for (std::string_view word = word_from(rest); !word.empty() && numbers.size() < 4;
         word = word_from(rest)) {
        double value = 0;
        const auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), value);
        if (problem != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) break;
        numbers.push_back(value);
    }
    return numbers;
}

std::string lower(std::string_view word) {
    std::string result;
    for (const char c : word) result += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return result;
}

}  // namespace importing::obj
