// Writes the files of targets.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "candela/target.h"

namespace candela::target {

void write(FileSink& files, const char* name, std::string_view content);

/// A new folder in `parent`, which is removed with this object. Code in plugins cannot use the sandbox's,
/// which is also removed when a signal ends the program: signal handlers are the program's.
class TemporaryFolder {
  public:
    /// Throws std::runtime_error if it cannot be created.
    explicit TemporaryFolder(std::string_view name,
                             const std::filesystem::path& parent = std::filesystem::temp_directory_path());
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    ~TemporaryFolder();
    const std::filesystem::path& path() const noexcept { return path_; }

  private:
    std::filesystem::path path_;
};

/// Writes a file of this machine completely or not at all. Throws std::exception.
void write_whole(const std::filesystem::path& file, std::string_view content);

/// A part of a C++17 program that writes 8-bit pictures, put_number() to write_image(): PNG and PPM.
std::string_view image_file_source();

}  // namespace candela::target
