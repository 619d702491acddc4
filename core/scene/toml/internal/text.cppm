// The text of a document before toml++ sees it, and what toml++ says of it.
module;

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

module candela.toml:text;

import candela.diagnostics;

namespace candela {

/// Says why a file cannot be read, or returns its text: UTF-8 or not, but no binary file, and not empty. A
/// file of more than `bytes_left` is refused; else its size is taken off.
std::optional<std::string> text_of_file(const std::filesystem::path& file, const std::string& shown_name,
                                        std::uintmax_t& bytes_left, Diagnostics& diagnostics);

/// The place of a byte of a text.
SourcePlace place_at(std::string_view text, std::size_t offset, const std::string& shown_name);

struct Excess {
    std::size_t offset = 0;  // in bytes; what is before it is not too much
    std::string message;
};

/// Where brackets nest so deep, or keys have so many parts, that going down there by recursion is a danger;
/// or where there are more than `values_left` values. Else takes off how many there are.
std::optional<Excess> first_excess(std::string_view text, std::size_t& values_left);

struct SyntaxProblem {
    std::string message;
    std::string hint;
};

/// What toml++ says of a text, as a person says it. `line` is the line of the problem, `column` its place
/// therein.
SyntaxProblem syntax_problem(std::string_view description, std::string_view line, int column);

}  // namespace candela
