// What must hold of a kernel that was accepted, as far as its text shows it.
#pragma once

#include <string>

#include "candela/kernel_language/language.h"

namespace fuzz {

/// Writes it, reads that again, and looks at every sign of it.
void check_accepted(const candela::kernel_language::Kernel& kernel);

/// A problem is on a line of its text, and said.
void check_problem(const candela::kernel_language::Problem& problem, std::string_view text);

}  // namespace fuzz
