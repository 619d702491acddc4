module;

#include <sys/wait.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <mutex>
#include <thread>

module candela.util;

namespace candela {

Overseer::Overseer(int process, const Patience& patience) : process_(process) {
    if (patience.longest || patience.unwanted.stop_possible())
        thread_ = std::thread([this, patience] { oversee(patience); });
}

Overseer::~Overseer() { dismiss(); }

ProgramEnd Overseer::await() {
    // Leaves the process to be waited for: until then, its ID is not reused.
    siginfo_t state{};
    while (::waitid(P_PID, static_cast<id_t>(process_), &state, WEXITED | WNOWAIT) < 0 && errno == EINTR) {
    }
    dismiss();
    return end_;
}

void Overseer::dismiss() {
    {
        const std::lock_guard lock(mutex_);
        has_ended_ = true;
    }
    news_.notify_all();
    if (thread_.joinable()) thread_.join();
}

void Overseer::oversee(const Patience& patience) {
    constexpr std::chrono::hours k_ever{24 * 365};
    constexpr std::chrono::seconds k_longest_end{2};
    std::unique_lock lock(mutex_);
    const auto has_ended = [this] { return has_ended_; };
    if (news_.wait_for(lock, patience.unwanted, patience.longest.value_or(k_ever), has_ended)) return;
    end_ = patience.unwanted.stop_requested() ? ProgramEnd::unwanted : ProgramEnd::late;
    ::kill(process_, SIGTERM);
    if (!news_.wait_for(lock, k_longest_end, has_ended)) ::kill(process_, SIGKILL);
}

}  // namespace candela
