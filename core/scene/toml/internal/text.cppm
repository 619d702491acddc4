// The text of a document before toml++ parses it, and toml++'s messages.
module;

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

module candela.scene:text;

import candela.util;

namespace candela {

/// The text of a file, which may not be UTF-8, but is neither binary nor empty; otherwise reports why it
/// cannot be read. A file larger than `bytes_left` is refused; otherwise its size is subtracted.
std::optional<std::string> text_of_file(const std::filesystem::path& file, const std::string& shown_name,
                                        std::uintmax_t& bytes_left, Diagnostics& diagnostics);

/// Like text_of_file(), for bytes that have been read already.
std::optional<std::string> text_of_bytes(std::string bytes, const std::string& shown_name,
                                         std::uintmax_t& bytes_left, Diagnostics& diagnostics);

/// A path as written at `place`: relative to its file's folder, or, on the command line (line 0), to the
/// working directory.
std::filesystem::path path_at(const SourceLocation& place, const std::string& written);

/// Checks that `file`, which is called `name` at `place`, is a regular file; otherwise reports why not.
/// Returns its absolute path.
std::optional<std::string> existing_file(const std::filesystem::path& file, const std::string& name,
                                         const SourceLocation& place, Diagnostics& diagnostics);

/// The position of a byte of a text.
SourceLocation place_at(std::string_view text, std::size_t offset, const std::string& shown_name);

struct Excess {
    std::size_t offset = 0;  // in bytes; everything before it is within the limits
    std::string message;
};

/// Finds the position where brackets nest so deeply, or keys have so many parts, that recursion would be
/// dangerous, or where the number of values exceeds `values_left`. Otherwise subtracts their number.
std::optional<Excess> first_excess(std::string_view text, std::size_t& values_left);

struct SyntaxProblem {
    std::string message;
    std::string hint;
};

/// toml++'s message in plain words. `line` is the line of the problem, `column` its position there.
SyntaxProblem syntax_problem(std::string_view description, std::string_view line, int column);

}  // namespace candela
