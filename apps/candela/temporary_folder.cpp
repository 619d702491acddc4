#include "temporary_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <ctime>
#include <random>
#include <string>
#include <system_error>

#include "directory_entries.h"

import candela.core;

namespace fs = std::filesystem;

namespace {

// Absolute paths, so that a change of the working directory leads nobody astray. None is ever freed: a signal
// handler may be reading it.
constinit std::array<std::atomic<const char*>, 8> folders{};

void remove_tree(int parent, const char* name, int levels) noexcept {
    if (::unlinkat(parent, name, 0) == 0 || (errno != EISDIR && errno != EPERM)) return;
    const int folder = ::openat(parent, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (folder >= 0) {
        if (levels > 0)
            for_each_entry(folder, [&](const char* entry) { remove_tree(folder, entry, levels - 1); });
        ::close(folder);
    }
    ::unlinkat(parent, name, AT_REMOVEDIR);
}

/// A program that has just been killed may have one system call left to finish.
void remove_folder(const char* path) noexcept {
    constexpr int k_levels = 64, k_attempts = 50;
    for (int i = 0; i < k_attempts; ++i) {
        remove_tree(AT_FDCWD, path, k_levels);
        if (::access(path, F_OK) != 0) return;
        const timespec pause{.tv_sec = 0, .tv_nsec = 20'000'000};
        ::nanosleep(&pause, nullptr);
    }
}

std::string random_name() {
    std::random_device random;
    // Short: browsers make sockets in such folders, whose paths may have 107 characters.
    return fmt::format("{:08x}", random());
}

}  // namespace

WithoutInterruption::WithoutInterruption() {
    sigset_t signals;
    ::sigemptyset(&signals);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) ::sigaddset(&signals, signal);
    ::pthread_sigmask(SIG_BLOCK, &signals, &before_);
}

WithoutInterruption::~WithoutInterruption() { ::pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

TemporaryFolder::TemporaryFolder(const fs::path& parent, const std::string& prefix)
    : path_(fs::absolute(parent) / (prefix + random_name())) {
    const WithoutInterruption during_this;
    if (::mkdir(path_.c_str(), 0777) != 0) {
        throw candela::Error(
            candela::ErrorCategory::failure,
            fmt::format("no folder can be made in '{}': {}", parent.string(), std::strerror(errno)));
    }
    enter();
}

TemporaryFolder::TemporaryFolder(const fs::path& existing) : path_(fs::absolute(existing)) { enter(); }

void TemporaryFolder::enter() {
    const char* const path = ::strdup(path_.c_str());
    for (std::atomic<const char*>& folder : folders) {
        const char* expected = nullptr;
        if (folder.compare_exchange_strong(expected, path)) return;
    }
}

void TemporaryFolder::release() {
    for (std::atomic<const char*>& folder : folders) {
        const char* const path = folder.load();
        if (path != nullptr && path_ == path) folder = nullptr;
    }
    is_released_ = true;
}

TemporaryFolder::~TemporaryFolder() {
    if (is_released_) return;
    remove_folder(path_.c_str());
    release();
}

bool has_temporary_folders() noexcept {
    for (const std::atomic<const char*>& folder : folders)
        if (folder.load() != nullptr) return true;
    return false;
}

void remove_temporary_folders() noexcept {
    for (std::atomic<const char*>& folder : folders)
        if (const char* const path = folder.exchange(nullptr)) remove_folder(path);
}
