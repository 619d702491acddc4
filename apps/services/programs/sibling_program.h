// Programs installed with the command, for libraries that it does not link itself.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

import candela.util;

/// The path of a file installed with the command, relative to the prefix.
std::filesystem::path beside_command(const char* relative);

/// The path lib/candela/`program`. Throws candela::Error if it does not exist ("`what` is not installed: …
/// (`where_from`)").
std::filesystem::path sibling_program(const char* program, const char* what, const char* where_from);

/// The path of candela-diff, which is in a package of its own. Throws like sibling_program().
std::filesystem::path comparing_program();

/// The path of candela-verbs, which has all of the command. Throws like sibling_program().
std::filesystem::path all_verbs();

/// The path of candela-conformance. Throws like sibling_program().
std::filesystem::path conformance_kit();

/// Replaces this process with the program. Throws candela::Error if it cannot be run.
[[noreturn]] void exec_sibling(const std::filesystem::path& file, const std::vector<std::string>& arguments);
