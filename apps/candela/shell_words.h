// Command lines as a shell takes them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

/// A word as a shell takes it.
std::string quoted_for_shell(const std::string& word);

/// The same for a part of a word that is typed in bash, outside quotation marks: with backslashes, as bash
/// itself completes names of files. Without control characters.
std::string quoted_for_bash(std::string_view part);

/// A command and its arguments, on one line.
std::string command_line_of(const std::vector<std::string>& words);
