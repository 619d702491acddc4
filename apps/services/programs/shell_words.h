// Quotes command lines for a shell.
#pragma once

#include <string>
#include <string_view>
#include <vector>

/// A word quoted for a shell.
std::string quoted_for_shell(const std::string& word);

/// Quotes a part of a word typed in bash outside quotation marks: with backslashes, as bash itself completes
/// file names. Without control characters.
std::string quoted_for_bash(std::string_view part);

/// A command and its arguments, on one line.
std::string command_line_of(const std::vector<std::string>& words);
