// Where candela verify builds and draws programs.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "output_folder.h"
#include "targets.h"
#include "temporary_folder.h"

/// A report comes into being beside its folder, so that an old one is whole until a new one replaces it. What
/// programs leave in the folder for temporary files or at home is gone when this is: from its construction
/// on, TMPDIR and HOME are folders in it.
class Workplace {
  public:
    explicit Workplace(const std::optional<std::string>& report);

    const std::filesystem::path& path() const { return draft_ ? draft_->draft() : temporary_.path(); }
    /// For files that are not part of the report.
    std::filesystem::path scratch(const std::string& name) const { return temporary_.path() / name; }

    /// Puts the report in its place, and takes away what is left there of another of these targets.
    void finish(const std::vector<LoadedTarget>& targets);
    /// A message of something that went wrong in the draft, about the place where it will be.
    std::string in_place(std::string message) const;

    /// The names of a report's pictures.
    static std::vector<std::filesystem::path> pictures_of(const std::vector<LoadedTarget>& targets);

  private:
    TemporaryFolder temporary_;
    std::filesystem::path report_;
    std::optional<OutputFolder> draft_;
};
