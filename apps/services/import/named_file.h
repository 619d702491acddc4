// Finds files that a model names in another system's way.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace importing {

/// An existing file.
struct NamedFile {
    std::filesystem::path path;
    /// Its name differs from the one in the model, in case or encoding.
    bool is_renamed = false;
};

/// The regular file that a model in `folder` calls `name`: verbatim; with Windows separators; without its
/// folders, if they are those of another machine; without quotes; ignoring case (ASCII); or in an encoding
/// other than UTF-8. Nothing if none of these exists.
std::optional<NamedFile> find_named(const std::filesystem::path& folder, std::string_view name);

}  // namespace importing
