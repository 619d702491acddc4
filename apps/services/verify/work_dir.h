// Where candela verify builds and runs programs.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "files/output_folder.h"
#include "sandbox/temporary_folder.h"
#include "verify/targets.h"

/// A report is made next to its folder, so that an old report stays intact until the new one replaces it.
/// TMPDIR and HOME point to folders inside it for as long as it exists, so what programs leave there is
/// deleted with it.
class Workplace {
  public:
    explicit Workplace(const std::optional<std::string>& report);

    const std::filesystem::path& path() const { return draft_ ? draft_->draft() : temporary_.path(); }
    /// For files that are not part of the report.
    std::filesystem::path scratch(const std::string& name) const { return temporary_.path() / name; }

    /// Moves the report to its place, and removes outdated files of these targets there.
    void finish(const std::vector<LoadedTarget>& targets);
    /// Rewrites a message about the draft to name the final place.
    std::string in_place(std::string message) const;

    /// The names of a report's pictures.
    static std::vector<std::filesystem::path> images_of(const std::vector<LoadedTarget>& targets);

  private:
    TemporaryFolder temporary_;
    std::filesystem::path report_;
    std::optional<OutputFolder> draft_;
};
