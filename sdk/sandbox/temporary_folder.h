// Folders that are removed when the command ends, however it ends, except by SIGKILL.
#pragma once

#include <csignal>
#include <filesystem>
#include <string>

import candela.util;

/// A new folder that only its owner may enter. It is removed with its contents on destruction, or when a
/// signal ends the process.
class TemporaryFolder {
  public:
    /// Creates it in `parent`, named `prefix` and random digits. Throws candela::Error (failure).
    explicit TemporaryFolder(const std::string& prefix,
                             const std::filesystem::path& parent = std::filesystem::temp_directory_path());
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    ~TemporaryFolder();

    const std::filesystem::path& path() const { return path_; }

  private:
    void enter();

    std::filesystem::path path_;
};

/// RAII guard: defers SIGINT, SIGTERM and SIGHUP on this thread until its destruction.
class WithoutInterruption {
  public:
    WithoutInterruption();
    WithoutInterruption(const WithoutInterruption&) = delete;
    WithoutInterruption& operator=(const WithoutInterruption&) = delete;
    ~WithoutInterruption();

  private:
    sigset_t before_;
};

bool has_temporary_folders() noexcept;

/// Async-signal-safe.
void remove_temporary_folders() noexcept;
