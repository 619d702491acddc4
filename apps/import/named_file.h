// Files that a model names the way another system does.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace importing {

/// A file that is there.
struct NamedFile {
    std::filesystem::path path;
    /// It has another name than the model gives it: other letters are capitals, or they are encoded
    /// otherwise.
    bool is_renamed = false;
};

/// The regular file that a model in `folder` calls `name`: as it stands; with Windows' separators; without
/// its folders, which are those of another machine; in quotes; with other capitals (ASCII); or with letters
/// in an encoding other than UTF-8. Nothing if there is none of these.
std::optional<NamedFile> find_named(const std::filesystem::path& folder, std::string_view name);

}  // namespace importing
