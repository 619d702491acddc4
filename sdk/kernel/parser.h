// From tokens to a kernel whose types and names are still unchecked.
#pragma once

#include <cstdint>
#include <vector>

#include "candela/kernel_language/syntax.h"
#include "tokens.h"

namespace candela::kernel_language {

/// The declarations of a whole kernel. Throws Refusal.
std::vector<Declaration> parsed_kernel(const std::vector<Token>& tokens);

/// The statements of a function's body without its braces. Throws Refusal.
std::vector<Statement> parsed_body(const std::vector<Token>& tokens);

}  // namespace candela::kernel_language
