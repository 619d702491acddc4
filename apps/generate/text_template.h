// Generated files begin as files of share/candela/generate, with places to fill.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace generate {

/// Where the templates are.
struct Templates {
    std::filesystem::path directory;

    /// The text of one. Throws candela::Error where it is not installed.
    std::string text(const std::string& name) const;
};

/// What stands where: {"TITLE", "..."} for @TITLE@.
using Values = std::vector<std::pair<std::string, std::string>>;

/// `text` with its places filled, in one pass: what is filled in is never looked at again. A line of nothing
/// but a place goes where the value is empty. Throws std::logic_error for a place that has no value.
std::string filled(const std::string& text, const Values& values);

}  // namespace generate
