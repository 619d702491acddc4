// Invariants of an accepted kernel, as far as its text shows them.
#pragma once

#include <string>

#include "candela/kernel_language/language.h"

namespace fuzz {

/// Writes it, reads that again, and checks every token.
void check_accepted(const candela::kernel_language::Kernel& kernel);

/// Checks that a problem is on a line of its text, and has a message.
void check_problem(const candela::kernel_language::Problem& problem, std::string_view text);

}  // namespace fuzz
