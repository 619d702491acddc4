// The declarations that every kernel can use, and positions of problems in texts.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "candela/kernel_language/language.h"
#include "candela/kernel_language/syntax.h"

namespace candela::kernel_language {

/// The declarations of prelude.kernel, checked.
const std::vector<Declaration>& prelude_declarations();

/// A problem at a byte of a text.
Problem problem_at(const Source& source, std::size_t offset, const std::string& message);

}  // namespace candela::kernel_language
