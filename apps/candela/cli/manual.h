// Manual pages, made from the output of --help.
#pragma once

#include <boost/program_options.hpp>
#include <span>
#include <string>

#include "cli/commands.h"

/// The page of one verb for man: troff with the macros of man(7). `usage` and `explanation` are those of a
/// CommandLine.
std::string manual_page(const std::string& usage, const std::string& explanation,
                        const boost::program_options::options_description& options);

/// The page of the command as a whole.
std::string manual_page(std::span<const Verb> verbs);
