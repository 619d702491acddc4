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
#include <cstdlib>
#include <cstring>
#include <ctime>

#include "candela/file_descriptor.h"
#include "sandbox/directory_entries.h"

namespace {

constinit std::atomic<bool> are_to_end{false}, are_ending{false};

/// A path under /proc, built without allocating.
class ProcPath {
  public:
    ProcPath& add(const char* text) noexcept {
        const std::size_t length = std::strlen(text);
        if (size_ + length < sizeof text_) {
            std::memcpy(text_ + size_, text, length + 1);
            size_ += length;
        }
        return *this;
    }
    ProcPath& add(pid_t number) noexcept {
        char digits[24] = {};
        char* at = digits + sizeof digits - 1;
        do {
            *--at = static_cast<char>('0' + number % 10);
            number /= 10;
        } while (number > 0);
        return add(at);
    }
    const char* c_str() const noexcept { return text_; }

  private:
    char text_[96] = "/proc/";
    std::size_t size_ = 6;
};

/// Calls visit(pid) for each process that a thread has started.
template <class Visit>
void for_each_child_of_thread(pid_t process, const char* thread, const Visit& visit) noexcept {
    const candela::FileDescriptor file(::open(
        ProcPath().add(process).add("/task/").add(thread).add("/children").c_str(), O_RDONLY | O_CLOEXEC));
    if (!file.is_open()) return;
    pid_t number = 0;
    char c = 0;
    while (::read(file.number(), &c, 1) == 1) {
        if (c >= '0' && c <= '9') {
            number = 10 * number + (c - '0');
        } else if (number > 0) {
            visit(number);
            number = 0;
        }
    }
}

template <class Visit>
void for_each_child(pid_t process, const Visit& visit) noexcept {
    const candela::FileDescriptor threads(
        ::open(ProcPath().add(process).add("/task").c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (!threads.is_open()) return;
    for_each_entry(threads.number(),
                   [&](const char* thread) { for_each_child_of_thread(process, thread, visit); });
}

/// `levels`: the recursion limit, to spare a signal handler's stack.
void kill_tree(pid_t process, int levels) noexcept {
    ::kill(process, SIGSTOP);  // so that it starts no others
    if (levels > 0) for_each_child(process, [&](pid_t child) { kill_tree(child, levels - 1); });
    ::kill(process, SIGKILL);
}

}  // namespace

void inherit_orphans() noexcept { ::prctl(PR_SET_CHILD_SUBREAPER, 1); }

void let_descendants_end() noexcept {
    constexpr int k_rounds = 500, k_empty_rounds = 3;
    constexpr timespec k_pause{.tv_sec = 0, .tv_nsec = 10'000'000};
    const pid_t self = ::getpid();
    are_ending = true;
    // Another thread may be about to start a process; the next round sees it.
    for (int i = 0, empty = 0; i < k_rounds && empty < k_empty_rounds; ++i) {
        ++empty;
        for_each_child(self, [&](pid_t child) {
            empty = 0;
            ::kill(child, SIGTERM);
            ::kill(child, SIGCONT);
            ::waitpid(child, nullptr, WNOHANG);
        });
        ::nanosleep(&k_pause, nullptr);
    }
}

void end_descendants() noexcept {
    constexpr int k_levels = 12, k_generations = 20;
    const pid_t self = ::getpid();
    are_ending = true;
    // Processes orphaned by this have become children.
    for (int i = 0; i < k_generations; ++i) {
        // Does not wait for any child: one that another thread starts meanwhile may never end.
        std::array<pid_t, 64> killed{};
        std::size_t count = 0;
        for_each_child(self, [&](pid_t child) {
            kill_tree(child, k_levels);
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
