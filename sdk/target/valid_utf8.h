// Text from outside, as UTF-8.
#pragma once

#include <string>
#include <string_view>

namespace candela::target {

/// Replaces everything that is not UTF-8 by U+FFFD.
std::string valid_utf8(std::string_view text);

}  // namespace candela::target
