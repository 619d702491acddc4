// Syntax errors in plain words, for those who have not read the TOML specification.
module;

#include <fmt/args.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <string>
#include <string_view>

module candela.scene;

import :text;
import candela.util;

namespace candela {

namespace {

/// `while_reading` and `says` are parts of toml++'s message: "Error while parsing <while_reading>: <…says…>".
/// In `message` and `hint`, {word} is the text at the problem's position up to the next space or separator,
/// {found} its first {character} or whatever else is there, {quoted} what toml++ put in quotes.
struct Rule {
    std::string_view while_reading;
    std::string_view says;
    std::string_view message;
    std::string_view hint;
};

constexpr std::array k_rules = {
    // Strings
    Rule{"string", "encountered end-of-file", "the file ends within a string: its closing quote is missing",
         ""},
    Rule{"string", "control characters", "{control}",
         R"(a string ends with the quote it begins with; one of several lines is enclosed in """)"},
    Rule{"string", "unknown escape sequence", "\\{character} is not a valid escape",
         "write a backslash as \\\\, or put the string in 'single quotes'"},
    // Numbers and words
    Rule{"integer", "not representable", "{word} is too large for an integer",
         "with a decimal point, as in 1.0e20, it is a real number"},
    Rule{"integer", "leading zeroes", "{word} is not a number, because it begins with 0", ""},
    Rule{"integer", "", "{word} is not a number", "numbers are written 12, 0.5 or 2e-3, without a unit"},
    Rule{"floating-point", "expected 'nan'", "{word} is not a value", "strings are quoted"},
    Rule{"floating-point", "expected 'inf'", "{word} is not a value", "strings are quoted"},
    Rule{"floating-point", "", "{word} is not a number",
         "numbers are written 12, 0.5 or 2e-3, with digits on both sides of the point"},
    Rule{"boolean", "", "{word} is not a value", "write true or false, or a quoted string"},
    Rule{"value", "could not determine", "{word} is not a value",
         "a value is a number, a string in \"straight quotes\", true, false or a [list, of, them]"},
    // Lists and inline tables
    Rule{"array", "encountered end-of-file", "the file ends within a list: its closing ] is missing", ""},
    Rule{"array", "expected comma", "expected ',' or ']' in this list, found {found}",
         "commas separate the values of a list"},
    Rule{"inline table", "encountered end-of-file", "the file ends within a table: its closing }} is missing",
         ""},
    Rule{"inline table", "dangling comma", "a comma before the closing }} is not allowed", ""},
    Rule{"inline table", "", "expected a key, ',' or '}}' in this table, found {found}",
         "a table in braces must be on one line"},
    // Headers
    Rule{"table header", "blank bare keys", "a header without a name", "write [image], for example"},
    Rule{"table header", "expected ']'", "the header's closing ] is missing", ""},
    Rule{"table header", "encountered end-of-file", "the file ends within a header: its closing ] is missing",
         ""},
    Rule{"table header", "expected a comment or whitespace",
         "expected the end of the line after the header, found {found}", "each key needs its own line"},
    Rule{"table header", "as array-of-tables", "{quoted} was a table or a value before; here it is a list",
         "each header of a list has two brackets, [[light]], all others have one, [image]"},
    Rule{"table header", "redefine existing array", "{quoted} was a list before; here it is a table",
         "each header of a list has two brackets, [[light]], all others have one, [image]"},
    Rule{"table header", "redefine existing", "{quoted} is already there",
         "all keys of a table belong below one header"},
    Rule{"table header", "cannot insert", "{quoted} cannot be extended, because it is written in braces", ""},
    // Lines
    Rule{"key", "redefine existing", "{quoted} is given twice in one table", ""},
    Rule{"key", "encountered end-of-file", "the file ends before '=' and a value", ""},
    Rule{"key-value pair", "expected '='", "expected '=' after the key, found {found}",
         "write: key = value; a key with characters other than A-Z, a-z, 0-9, _ and - is quoted"},
    Rule{"key-value pair", "expected value", "there is no value after '='", ""},
    Rule{"key-value pair", "expected a comment or whitespace",
         "expected the end of the line after the value, found {found}",
         "one value per line; a decimal point is not a comma; units are left out; strings are quoted"},
    Rule{"root table", "expected keys", "expected a key or a [table], found {found}",
         "comments begin with #; a scene is TOML, not JSON, YAML or XML"},
    Rule{"", "after '\\r'", "a line ends with a carriage return alone",
         "save the file with the line ends of Unix or Windows"},
    Rule{"comment", "control characters", "{control}", ""},
};

std::string quoted(std::string_view text) { return fmt::format("'{}'", shortened(text)); }

/// The byte at which column `column` begins.
std::size_t offset_of(std::string_view line, int column) {
    std::size_t at = 0;
    for (int i = 1; i < column && at < line.size(); ++i) at += first_character(line.substr(at)).size();
    return at;
}

/// The word or number around the position, as a reader would see it.
std::string word_at(std::string_view line, std::size_t at) {
    const auto ends = [](char c) {
        return std::string_view(" \t,=[]{}#\"").find(c) != std::string_view::npos;
    };
    std::size_t begin = std::min(at, line.size());
    while (begin > 0 && !ends(line[begin - 1])) --begin;
    std::size_t end = begin;
    while (end < line.size() && !ends(line[end])) ++end;
    if (begin == end && begin < line.size()) ++end;
    return begin == end ? "this" : quoted(line.substr(begin, end - begin));
}

/// The last text that toml++ itself put in quotes.
std::string quoted_in(std::string_view description) {
    const std::size_t end = description.rfind('\'');
    const std::size_t begin =
        end == std::string_view::npos || end == 0 ? end : description.rfind('\'', end - 1);
    if (begin == std::string_view::npos || begin >= end) return "this";
    return quoted(description.substr(begin + 1, end - begin - 1));
}

}  // namespace

SyntaxProblem syntax_problem(std::string_view description, std::string_view line, int column) {
    constexpr std::string_view k_prefix = "Error while parsing ";
    std::string_view scope;
    std::string_view reason = description;
    if (reason.starts_with(k_prefix)) {
        reason.remove_prefix(k_prefix.size());
        const std::size_t colon = reason.find(": ");
        if (colon != std::string_view::npos) {
            scope = reason.substr(0, colon);
            reason.remove_prefix(colon + 2);
        }
    }
    const std::size_t at = offset_of(line, column);
    const std::string_view character = first_character(line.substr(at));
    const std::string found = character.empty() ? "the end of the line" : fmt::format("'{}'", character);
    const std::string control = character.empty() ? "this string has no closing quote on its line"
                                                  : "a control character, which strings must not contain";
    for (const Rule& rule : k_rules) {
        if (scope.find(rule.while_reading) == std::string_view::npos ||
            reason.find(rule.says) == std::string_view::npos)
            continue;
        const auto filled = [&](std::string_view pattern) {
            return fmt::format(fmt::runtime(pattern), fmt::arg("word", word_at(line, at)),
                               fmt::arg("found", found), fmt::arg("character", character),
                               fmt::arg("control", control), fmt::arg("quoted", quoted_in(description)));
        };
        return {filled(rule.message), std::string(rule.hint)};
    }
    return {scope.empty() ? std::string(reason) : fmt::format("this is not a {}: {}", scope, reason), ""};
}

}  // namespace candela
