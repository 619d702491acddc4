// Text in lines that fit the terminal.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

/// How many columns there are on standard output: what COLUMNS says, else the terminal's, else 80; at
/// least 40.
std::size_t output_width();

/// A text in lines of at most `width` columns, where its words allow that; all lines but the first begin with
/// `indent` spaces, and the first already has `begin` columns before it.
std::string wrapped(std::string_view text, std::size_t begin, std::size_t indent,
                    std::size_t width = output_width());

/// A row of two columns with a line break: `left` after `margin` spaces, and `right` wrapped beside it, from
/// column `margin` + `left_width` + 1 on.
std::string row(std::string_view left, std::string_view right, std::size_t left_width, std::size_t margin = 2,
                std::size_t width = output_width());

/// Paragraphs, each wrapped. A line break within a paragraph is a space; a line that begins with spaces is a
/// row of two columns, separated by two spaces or more, and stands by itself.
std::string wrapped_paragraphs(std::string_view text, std::size_t width = output_width());
