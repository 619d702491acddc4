// Checks of an output file before a verb writes it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/command_line.h"

import candela.util;

/// Adds --no-clobber.
void add_no_clobber_option(CommandLine& line);

/// How to treat an existing file: keep it with --no-clobber.
candela::Existing existing_from(const CommandLine& line);

/// Throws Error (failure) if --no-clobber forbids writing the file, or its folder is missing: better to find
/// out before the work than after it.
void require_free(const std::string& output, candela::Existing existing);

/// Throws Error (bad_request) if `output` is "-" (standard output) and that is a terminal.
void require_no_terminal(const std::string& output, const std::string& what = "a PNG");

/// Throws Error (failure) if the output has its default name because `option` gives no other, and that name
/// is a symbolic link: it may lead anywhere, and the user did not choose it.
void require_no_default_link(const CommandLine& line, const std::string& option,
                             const std::filesystem::path& output);

/// Throws Error (bad_request) if `output` is, by whatever path, the file of one of `inputs`, or part of a
/// model among them, such as a buffer: "'a.png' is one of `inputs_are`; `remedy`".
void require_no_input(const std::string& output, const std::vector<std::filesystem::path>& inputs,
                      const std::string& inputs_are, const std::string& remedy);

/// Like require_no_input(), for the files that a scene is made from; `what`: "the picture".
void require_no_scene_file(const std::string& output, const std::vector<std::filesystem::path>& inputs,
                           const std::string& what);
