// Programs beside the command, for what it is not linked to itself.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

import candela.diagnostics;

/// Where something is that is installed beside the command, relative to the prefix.
std::filesystem::path beside_command(const char* relative);

/// lib/candela/`program`. Throws candela::Error where it is not there ("`what` is not installed: …
/// (`where_from`)").
std::filesystem::path helper(const char* program, const char* what, const char* where_from);

/// candela-diff. Throws like helper(): it is in a package of its own.
std::filesystem::path comparing_program();

/// candela-conformance. Throws likewise.
std::filesystem::path conformance_kit();

/// Becomes this program. Throws candela::Error where it cannot be run.
[[noreturn]] void become_helper(const std::filesystem::path& file, const std::vector<std::string>& arguments);
