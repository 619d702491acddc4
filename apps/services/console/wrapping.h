// Wraps text to the terminal's width.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

/// The number of columns of standard output: from COLUMNS, otherwise the terminal's, otherwise 80; at least
/// 40.
std::size_t output_width();

/// A text in lines of at most `width` columns, as far as its words allow. All lines but the first are
/// indented by `indent` spaces; the first starts at column `begin`.
std::string wrapped(std::string_view text, std::size_t begin, std::size_t indent,
                    std::size_t width = output_width());

/// A row of two columns with a line break: `left` after `margin` spaces, and `right`, wrapped, from column
/// `margin` + `left_width` + 1 on.
std::string row(std::string_view left, std::string_view right, std::size_t left_width, std::size_t margin = 2,
                std::size_t width = output_width());

/// Paragraphs, each wrapped. A line break within a paragraph becomes a space. A line that begins with spaces
/// is a row of two columns, separated by two or more spaces, and is not joined with others.
std::string wrapped_paragraphs(std::string_view text, std::size_t width = output_width());
