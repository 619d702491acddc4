// Programs beside the command, for what it is not linked to itself.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

/// Where something is that is installed beside the command, relative to the prefix.
std::filesystem::path beside_command(const char* relative);

/// Becomes lib/candela/`program`. Throws candela::Error where it is not there ("`what` is not installed: …
/// (`where_from`)") or cannot be run.
[[noreturn]] void become_helper(const std::string& program, const std::vector<std::string>& arguments,
                                const char* what, const char* where_from);
