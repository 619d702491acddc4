// Text templates with placeholders.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace candela::target {

/// Placeholders and their values: {"TITLE", "..."} for @TITLE@.
using Values = std::vector<std::pair<std::string, std::string>>;
/// Like Values, for texts that are stored elsewhere.
using ValueViews = std::vector<std::pair<std::string_view, std::string_view>>;

ValueViews views_of(const Values& values);

/// `text` with its placeholders replaced in one pass: replacements are not searched again. A line that
/// consists of a placeholder with an empty value is removed. Throws std::logic_error for a placeholder
/// without a value.
std::string filled(std::string_view text, const ValueViews& values);

}  // namespace candela::target
