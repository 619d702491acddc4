// What must hold of a file before a verb writes it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "command_line.h"

import candela.files;

/// Adds --no-clobber.
void add_no_clobber_option(CommandLine& line);

/// What becomes of a file that exists: it is kept with --no-clobber.
candela::Existing existing_from(const CommandLine& line);

/// Throws Error (failure) where --no-clobber forbids to write the file, or its folder is missing: better to
/// know before the work is done than after it.
void require_free(const std::string& output, candela::Existing existing);

/// Throws Error (bad_request) where `output` is "-", standard output, and that is a terminal.
void require_no_terminal(const std::string& output, const std::string& what = "a PNG");

/// Throws Error (failure) where the output has its default name because `option` does not give another, and a
/// symbolic link is there: it may lead anywhere, and nobody has chosen it.
void require_no_default_link(const CommandLine& line, const std::string& option,
                             const std::filesystem::path& output);

/// Throws Error (bad_request) where `output` is the file of one of `inputs`, by whatever path, or a part of a
/// model among them, such as a buffer: "'a.png' is one of `inputs_are`; `remedy`".
void require_no_input(const std::string& output, const std::vector<std::filesystem::path>& inputs,
                      const std::string& inputs_are, const std::string& remedy);

/// The same of the files that a scene is made from; `what`: "the picture".
void require_no_scene_file(const std::string& output, const std::vector<std::filesystem::path>& inputs,
                           const std::string& what);
