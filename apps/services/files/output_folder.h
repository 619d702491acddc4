// Folders of files, written completely or not at all.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "sandbox/temporary_folder.h"

import candela.util;

/// Files on their way to a folder. They are written to a temporary folder next to it and moved together once
/// all are complete, so that a full disk or a signal leaves the folder as it was: absent, or with all of its
/// old files. Other files in it stay. Links in place of its files are replaced; links in place of its folders
/// are errors. One thread.
class OutputFolder {
  public:
    /// `links`: whether `target` may be a link, because the user chose its name. Throws candela::Error
    /// (failure) if it cannot become a folder.
    explicit OutputFolder(const std::filesystem::path& target,
                          candela::Links links = candela::Links::followed);

    /// `name` is relative and may contain folders. Throws candela::Error (failure).
    void write(const std::filesystem::path& name, std::string_view content);
    /// The folder that holds the files until finish(), for other code that adds some.
    const std::filesystem::path& draft() const { return draft_; }
    /// Moves all files into place and removes the older files of these names. Call it once, at the end.
    /// Throws candela::Error (failure).
    void finish(const std::vector<std::filesystem::path>& outdated = {});

  private:
    std::filesystem::path target_;
    TemporaryFolder beside_;
    std::filesystem::path draft_;  // inside it, because it becomes a folder that others may enter
};

/// The folder that contains a file.
std::filesystem::path folder_of(const std::filesystem::path& file);

/// Creates a folder and its parents. Throws candela::Error (failure).
void make_folder(const std::filesystem::path& folder);
