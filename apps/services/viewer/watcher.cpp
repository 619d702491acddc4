#include "viewer/watcher.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/inotify.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <system_error>
#include <utility>

import candela.util;

namespace view {

namespace fs = std::filesystem;

namespace {

constexpr int k_quiet_ms = 4;     // a program that saves several files writes the next one within this time
constexpr int k_most_quiet = 50;  // intervals; then report a change even if others follow
// Not IN_CREATE: a newly created file is empty, and closing it is an event of its own.
constexpr std::uint32_t k_changes = IN_CLOSE_WRITE | IN_MOVED_TO | IN_MOVED_FROM | IN_DELETE | IN_ONLYDIR;

int valid(int descriptor) {
    if (descriptor >= 0) return descriptor;
    throw candela::Error(candela::ErrorCategory::failure,
                         fmt::format("cannot watch files: {}", std::strerror(errno)));
}

}  // namespace

Watcher::Watcher()
    : events_(valid(::inotify_init1(IN_NONBLOCK | IN_CLOEXEC))),
      stop_(valid(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC))) {}

void Watcher::add(const fs::path& folder, const std::string& name) {
    const int watch = ::inotify_add_watch(events_.number(), folder.empty() ? "." : folder.c_str(), k_changes);
    if (watch >= 0) {
        names_[watch].insert(name);
    } else if (errno == ENOSPC || errno == ENOMEM) {
        throw candela::Error(candela::ErrorCategory::failure,
                             fmt::format("cannot watch '{}': {}", folder.string(),
                                         errno == ENOSPC ? "the system's limit is reached "
                                                           "(fs.inotify.max_user_watches)"
                                                         : std::strerror(errno)));
    }
    // A missing folder cannot change.
}

void Watcher::watch(const std::vector<fs::path>& files, const std::vector<fs::path>& folders) {
    const std::map<int, std::set<std::string>> before = std::exchange(names_, {});
    for (const fs::path& file : files) {
        add(file.parent_path(), file.filename().string());
        // Both a link and its target can be replaced.
        std::error_code problem;
        const fs::path target = fs::canonical(file, problem);
        if (!problem && target != file) add(target.parent_path(), target.filename().string());
    }
    for (const fs::path& folder : folders) add(folder, "");
    for (const auto& [watch, names] : before)
        if (!names_.contains(watch)) ::inotify_rm_watch(events_.number(), watch);
}

bool Watcher::read_events() {
    bool is_relevant = false;
    alignas(inotify_event) std::array<char, 16384> buffer{};
    for (;;) {
        const ssize_t size = ::read(events_.number(), buffer.data(), buffer.size());
        if (size <= 0) return is_relevant;
        for (std::size_t at = 0; at < static_cast<std::size_t>(size);) {
            inotify_event event{};
            std::memcpy(&event, buffer.data() + at, sizeof event);
            const char* const name = buffer.data() + at + sizeof event;
            at += sizeof event + event.len;
            const auto watched = names_.find(event.wd);
            const bool has_name = event.len > 0;
            is_relevant |= (event.mask & IN_Q_OVERFLOW) != 0 ||
                           (watched != names_.end() && has_name &&
                            (watched->second.contains("") || watched->second.contains(name)));
        }
    }
}

bool Watcher::wait() {
    std::array<pollfd, 2> sources{pollfd{.fd = events_.number(), .events = POLLIN, .revents = 0},
                                  pollfd{.fd = stop_.number(), .events = POLLIN, .revents = 0}};
    bool is_changed = false;
    for (int moments = 0; moments < k_most_quiet; ++moments) {
        const int ready = ::poll(sources.data(), sources.size(), is_changed ? k_quiet_ms : -1);
        if (sources[1].revents != 0) return false;
        if (ready == 0) break;
        is_changed |= read_events();
        if (!is_changed) moments = -1;
    }
    return true;
}

bool Watcher::is_quiet_for(std::chrono::milliseconds time) const {
    std::array<pollfd, 2> sources{pollfd{.fd = events_.number(), .events = POLLIN, .revents = 0},
                                  pollfd{.fd = stop_.number(), .events = POLLIN, .revents = 0}};
    return ::poll(sources.data(), sources.size(), static_cast<int>(time.count())) == 0;
}

void Watcher::stop() noexcept {
    const std::uint64_t one = 1;
    static_cast<void>(::write(stop_.number(), &one, sizeof one));
}

}  // namespace view
