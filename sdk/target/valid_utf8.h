// Text from outside, as UTF-8.
#pragma once

#include <string>
#include <string_view>

namespace candela::target {

/// With U+FFFD for what is no UTF-8.
std::string valid_utf8(std::string_view text);

}  // namespace candela::target
