// Verbs of verbs: `candela plugin new`.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "verbs.h"

/// Runs the one of `verbs` that the first argument names, with the rest. Throws candela::Error (bad_request)
/// with a suggestion for one that there is not; prints all, with exit code 2, where there is none.
int run_subverb(const std::string& verb, std::span<const Verb> verbs,
                const std::vector<std::string>& arguments);
