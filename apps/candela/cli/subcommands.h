// Verbs of verbs: `candela plugin new`.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "cli/commands.h"

/// Runs the one of `verbs` that the first argument names, with the remaining arguments. Throws candela::Error
/// (bad_request), with a suggestion, for an unknown verb; without arguments, prints all verbs and returns
/// exit code 2.
int run_subverb(const std::string& verb, std::span<const Verb> verbs,
                const std::vector<std::string>& arguments);
