// Command lines as a shell takes them.
#pragma once

#include <string>
#include <vector>

/// A word as a shell takes it.
std::string quoted_for_shell(const std::string& word);

/// A command and its arguments, on one line.
std::string command_line_of(const std::vector<std::string>& words);
