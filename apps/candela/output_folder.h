// Folders of files, written whole or not at all.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "temporary_folder.h"

import candela.files;

/// Files on their way to a folder. They are written beside their places and are moved there together once all
/// are whole, so that a full disk or a signal leaves the folder as it was: not there, or with all of its old
/// files. What else is in it stays. Of links in the place of its files and folders, the former are replaced
/// and the latter are errors. One thread.
class OutputFolder {
  public:
    /// `links`: whether `target` may be one, because a person chose its name. Throws candela::Error (failure)
    /// where it cannot become a folder.
    explicit OutputFolder(const std::filesystem::path& target,
                          candela::Links links = candela::Links::followed);

    /// `name` is relative, and may be in folders of its own. Throws candela::Error (failure).
    void write(const std::filesystem::path& name, std::string_view content);
    /// Where the files are until finish(), for whoever else makes some.
    const std::filesystem::path& draft() const { return draft_; }
    /// Moves all of them, and removes the files of these names that are older. Call it once, at the end.
    /// Throws candela::Error (failure).
    void finish(const std::vector<std::filesystem::path>& outdated = {});

  private:
    std::filesystem::path target_;
    TemporaryFolder beside_;
    std::filesystem::path draft_;  // in it, since it becomes a folder that others may enter
};

/// The folder that a file is in.
std::filesystem::path folder_of(const std::filesystem::path& file);

/// Makes a folder, and those that it is in. Throws candela::Error (failure).
void make_folder(const std::filesystem::path& folder);
