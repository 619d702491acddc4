#include "sandbox/process_tree.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <ctime>

#include "candela/file_descriptor.h"
#include "sandbox/directory_entries.h"

using candela::FileDescriptor;

namespace {

constinit std::atomic<bool> are_to_end{false}, are_ending{false};

/// Calls visit(pid) for each process that this one has started, or inherited, and not waited for yet.
template <class Visit>
void for_each_child(const Visit& visit) noexcept {
    const FileDescriptor threads(::open("/proc/self/task", O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (threads.number() < 0) return;
    for_each_entry(threads.number(), [&](const char* name) {
        const FileDescriptor thread(::openat(threads.number(), name, O_PATH | O_DIRECTORY | O_CLOEXEC));
        if (thread.number() < 0) return;
        const FileDescriptor file(::openat(thread.number(), "children", O_RDONLY | O_CLOEXEC));
        pid_t number = 0;
        for (char c = 0; ::read(file.number(), &c, 1) == 1;) {
            if (c >= '0' && c <= '9') {
                number = 10 * number + (c - '0');
            } else if (number > 0) {
                visit(number);
                number = 0;
            }
        }
    });
}

}  // namespace

void inherit_orphans() noexcept { ::prctl(PR_SET_CHILD_SUBREAPER, 1); }

void let_descendants_end() noexcept {
    constexpr int k_rounds = 500, k_empty_rounds = 3;
    constexpr timespec k_pause{.tv_sec = 0, .tv_nsec = 10'000'000};
    are_ending = true;
    // Another thread may be about to start a process; the next round sees it.
    for (int i = 0, empty = 0; i < k_rounds && empty < k_empty_rounds; ++i) {
        ++empty;
        for_each_child([&](pid_t child) {
            empty = 0;
            ::kill(child, SIGTERM);
            ::kill(child, SIGCONT);
            ::waitpid(child, nullptr, WNOHANG);
        });
        ::nanosleep(&k_pause, nullptr);
    }
}

void end_descendants() noexcept {
    constexpr int k_generations = 30;
    are_ending = true;
    inherit_orphans();  // whose parents this kills
    for (int i = 0; i < k_generations; ++i) {
        // Does not wait for any child: one that another thread starts meanwhile may never end.
        std::array<pid_t, 64> killed{};
        std::size_t count = 0;
        for_each_child([&](pid_t child) {
            ::kill(child, SIGKILL);
            if (count < killed.size()) killed[count++] = child;
        });
        if (count == 0) return;
        for (std::size_t k = 0; k < count; ++k) {
            while (::waitpid(killed[k], nullptr, 0) < 0 && errno == EINTR) {
            }
        }
    }
}

void end_descendants_on_signals() noexcept { are_to_end = true; }

bool are_descendants_ended_on_signals() noexcept { return are_to_end; }

bool are_descendants_ending() noexcept { return are_ending; }
