// Folders that are gone when the command is, however it ends, unless by SIGKILL.
#pragma once

#include <csignal>
#include <filesystem>
#include <string>

import candela.diagnostics;

/// A new folder, which only its owner may enter, removed with all it contains when this is, or when a signal
/// ends the process.
class TemporaryFolder {
  public:
    /// In `parent`, with a name of `prefix` and random digits. Throws candela::Error (failure).
    TemporaryFolder(const std::filesystem::path& parent, const std::string& prefix);
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    ~TemporaryFolder();

    const std::filesystem::path& path() const { return path_; }

  private:
    void enter();

    std::filesystem::path path_;
};

/// While there is one, the thread is not interrupted by SIGINT, SIGTERM and SIGHUP; they come after it.
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
