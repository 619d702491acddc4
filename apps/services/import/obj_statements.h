// The lines of OBJ and MTL files.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace importing::obj {

/// A statement: its first word and the rest of the line.
struct Statement {
    std::string_view keyword, rest;
};

std::string_view trimmed(std::string_view text);
/// Takes the first word from `rest`.
std::string_view word_from(std::string_view& rest);
/// A material's name, which extends to the end of its line, with one blank between words, as in the shape
/// `mesh`.
std::string name_from(std::string_view rest);
/// The name without a possible comment: "red" of "red # the door".
std::string_view without_comment(std::string_view name);
/// Up to four finite numbers.
std::vector<double> numbers_from(std::string_view rest);
std::string lower(std::string_view word);

/// Calls `visit` for each line that is neither empty nor a comment; skips a byte order mark.
template <class Visit>
void each_statement(std::string_view text, Visit visit) {
    constexpr std::string_view k_mark = "\xef\xbb\xbf";
    if (text.starts_with(k_mark)) text.remove_prefix(k_mark.size());
    while (!text.empty()) {
        const std::size_t end = text.find_first_of("\r\n");
        std::string_view rest = text.substr(0, end);
        text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
        const std::string_view keyword = word_from(rest);
        if (!keyword.empty() && keyword.front() != '#') visit(Statement{keyword, rest});
    }
}

}  // namespace importing::obj
