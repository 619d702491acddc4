#include "shell_words.h"

#include <algorithm>
#include <cctype>
#include <string_view>

std::string quoted_for_shell(const std::string& word) {
    const auto is_plain = [](unsigned char c) {
        return std::isalnum(c) != 0 || c >= 0x80 ||
               std::string_view("._/-+,:@=%").find(static_cast<char>(c)) != std::string_view::npos;
    };
    if (!word.empty() && !word.starts_with('=') && std::ranges::all_of(word, is_plain)) return word;
    std::string result = "'";
    for (const char c : word) {
        if (c == '\'') {
            result += "'\\''";
        } else {
            result += c;
        }
    }
    return result + "'";
}

std::string command_line_of(const std::vector<std::string>& words) {
    std::string line;
    for (const std::string& word : words) line += (line.empty() ? "" : " ") + quoted_for_shell(word);
    return line;
}
