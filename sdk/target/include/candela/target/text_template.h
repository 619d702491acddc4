// Texts with places to fill.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace candela::target {

/// What stands where: {"TITLE", "..."} for @TITLE@.
using Values = std::vector<std::pair<std::string, std::string>>;
/// The same of texts that are kept elsewhere.
using ValueViews = std::vector<std::pair<std::string_view, std::string_view>>;

ValueViews views_of(const Values& values);

/// `text` with its places filled, in one pass: what is filled in is never looked at again. A line of nothing
/// but a place goes where the value is empty. Throws std::logic_error for a place that has no value.
std::string filled(std::string_view text, const ValueViews& values);

}  // namespace candela::target
