#include "programs/shell_words.h"

#include <algorithm>
#include <cctype>

namespace {

/// Whether no shell treats the character specially.
bool is_plain(char c) {
    const auto byte = static_cast<unsigned char>(c);
    return (byte < 0x80 && std::isalnum(byte) != 0) || byte >= 0x80 ||
           std::string_view("._/-+,:@=%").find(c) != std::string_view::npos;
}

}  // namespace

std::string quoted_for_bash(std::string_view part) {
    std::string result;
    for (const char c : part) {
        if (!is_plain(c)) result += '\\';
        result += c;
    }
    return result;
}

std::string quoted_for_shell(const std::string& word) {
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
