#include "sandbox/temporary_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <ctime>
#include <random>
#include <string>
#include <system_error>

#include "candela/file_descriptor.h"
#include "sandbox/directory_entries.h"

namespace fs = std::filesystem;

namespace {

/// A folder that a signal handler may have to remove, so its memory is never freed.
struct Entry {
    std::atomic<bool> is_taken{false};
    std::atomic<bool> is_there{false};  // `path` may be read
    // Absolute, so that a change of the working directory does no harm.
    std::array<char, PATH_MAX> path{};
};
constinit std::array<Entry, 8> folders{};

void remove_tree(int parent, const char* name, int levels) noexcept {
    if (::unlinkat(parent, name, 0) == 0 || (errno != EISDIR && errno != EPERM)) return;
    candela::FileDescriptor folder(::openat(parent, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
    if (folder.is_open() && levels > 0)
        for_each_entry(folder.number(),
                       [&](const char* entry) { remove_tree(folder.number(), entry, levels - 1); });
    folder.close();
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

/// Creates a folder private to the user, whatever the umask: code compiled in it is run or loaded. Returns
/// false and sets errno on failure.
bool make_private_folder(const char* path) noexcept {
    constexpr mode_t k_private = 0700;
    if (::mkdir(path, k_private) != 0) return false;
    struct stat status{};
    if (::lstat(path, &status) == 0 && (status.st_mode & k_private) == k_private) return true;
    // By its descriptor, because the path may lead elsewhere by now.
    const candela::FileDescriptor folder(::open(path, O_PATH | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
    if (!folder.is_open()) return false;
    const std::string self = fmt::format("/proc/self/fd/{}", folder.number());
    return ::chmod(self.c_str(), k_private) == 0;
}

std::string random_name() {
    std::random_device random;
    // Short: browsers create sockets in such folders, and the paths of sockets are limited to 107 characters.
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

TemporaryFolder::TemporaryFolder(const std::string& prefix, const fs::path& parent)
    : path_(fs::absolute(parent) / (prefix + random_name())) {
    const WithoutInterruption during_this;
    if (!make_private_folder(path_.c_str())) {
        throw candela::Error(
            candela::ErrorCategory::failure,
            fmt::format("no folder can be created in '{}': {}", parent.string(), std::strerror(errno)));
    }
    enter();
}

void TemporaryFolder::enter() {
    const std::string path = path_.string();
    for (Entry& folder : folders) {
        if (path.size() >= folder.path.size() || folder.is_taken.exchange(true)) continue;
        folder.path = {};
        std::ranges::copy(path, folder.path.begin());
        folder.is_there = true;
        return;
    }
}

TemporaryFolder::~TemporaryFolder() {
    remove_folder(path_.c_str());
    for (Entry& folder : folders) {
        if (!folder.is_there || std::strcmp(path_.c_str(), folder.path.data()) != 0) continue;
        folder.is_there = false;
        folder.is_taken = false;
    }
}

bool has_temporary_folders() noexcept {
    return std::ranges::any_of(folders, [](const Entry& folder) { return folder.is_there.load(); });
}

void remove_temporary_folders() noexcept {
    for (Entry& folder : folders)
        if (folder.is_there.exchange(false)) remove_folder(folder.path.data());
}
