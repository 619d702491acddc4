// The core's diagnostics and errors as text, with the help a program offers; and as JSON.
#pragma once

#include <cstddef>
#include <string>

import candela.util;

constexpr std::size_t k_most_diagnostics_shown = 50;

enum class Shown : bool { errors, errors_and_warnings };

/// How a program words a Help. Empty if there is nothing to say.
struct HelpWords {
    std::string (*after_message)(const candela::Help& help);  // the end of its sentence: ", or use --…"
    std::string (*hint)(const candela::Help& help);           // next to it: "(candela list light)"
};

/// The wording with the command's verbs and flags.
extern const HelpWords k_help_of_command;

/// The first `most` diagnostics as printable text, each with its line and a mark below the position, and the
/// number of omitted ones.
std::string diagnostics_text(const candela::Diagnostics& diagnostics, bool in_color,
                             std::size_t most = k_most_diagnostics_shown,
                             Shown shown = Shown::errors_and_warnings,
                             const HelpWords& words = k_help_of_command);

/// All diagnostics for programs: an array of objects with severity, file, line, column, length, message and
/// hint.
std::string diagnostics_json(const candela::Diagnostics& diagnostics);

/// The sentence of an error or a refusal, with advice.
std::string full_message(std::string message, const candela::Help& help,
                         const HelpWords& words = k_help_of_command);

/// The advice for a diagnostic; may be empty.
std::string full_hint(const candela::Diagnostic& diagnostic, const HelpWords& words = k_help_of_command);
