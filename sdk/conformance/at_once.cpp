#include "at_once.h"

#include <sys/select.h>
#include <unistd.h>

#include <atomic>
#include <barrier>
#include <cerrno>
#include <csignal>
#include <ctime>
#include <thread>
#include <vector>

namespace {

constexpr int k_meetings = 80;
constexpr long k_shortest_work = 20'000, k_longest_work = 180'000, k_pause = 50'000;  // nanoseconds

/// This thread's timer; null while the thread is not to be interrupted.
thread_local timer_t* volatile timer_of_this_thread = nullptr;

thread_local long interruption_count = 0;

/// Arms the timer once: a pending signal would otherwise stop the thread as soon as it runs again, before it
/// has done anything. The delay varies, because calls of equal duration would otherwise always be stopped at
/// the same place.
void interrupt_later(timer_t timer) {
    constexpr long k_range = k_longest_work - k_shortest_work;
    constexpr long k_step = 618 * k_range / 1000;  // the golden ratio spreads them evenly
    const long work = k_shortest_work + ++interruption_count * k_step % k_range;
    const itimerspec once{.it_interval = {}, .it_value = {.tv_sec = 0, .tv_nsec = work}};
    ::timer_settime(timer, 0, &once, nullptr);
}

void pause_here(int) {
    timer_t* const timer = timer_of_this_thread;
    if (timer == nullptr) return;
    const int error = errno;
    const timespec pause{.tv_sec = 0, .tv_nsec = k_pause};
    ::pselect(0, nullptr, nullptr, nullptr, &pause, nullptr);
    interrupt_later(*timer);
    errno = error;
}

/// While it exists, the thread that created it is paused again and again, wherever it is.
class Interruptions {
  public:
    /// If the system has no timers left, there are no interruptions.
    Interruptions() {
        sigevent event{};
        event.sigev_notify = SIGEV_THREAD_ID;
        event.sigev_signo = SIGALRM;
        event._sigev_un._tid = ::gettid();
        has_timer_ = ::timer_create(CLOCK_MONOTONIC, &event, &timer_) == 0;
        if (!has_timer_) return;
        timer_of_this_thread = &timer_;
        interrupt_later(timer_);
    }
    Interruptions(const Interruptions&) = delete;
    Interruptions& operator=(const Interruptions&) = delete;
    ~Interruptions() {
        timer_of_this_thread = nullptr;
        if (has_timer_) ::timer_delete(timer_);
    }

  private:
    timer_t timer_{};
    bool has_timer_ = false;
};

}  // namespace

bool hold_at_once(std::size_t threads, int rounds, std::chrono::steady_clock::time_point latest,
                  const std::function<bool(std::size_t thread)>& is_as_alone) {
    struct sigaction action{};
    action.sa_handler = pause_here;
    action.sa_flags = SA_RESTART;
    ::sigaction(SIGALRM, &action, nullptr);
    std::atomic<bool> all_hold = true;
    std::atomic<int> calls = 0, meetings = 0;
    const auto is_enough = [&](int done) {
        return done >= rounds && (meetings >= k_meetings || std::chrono::steady_clock::now() > latest);
    };
    std::barrier all_are_here(static_cast<std::ptrdiff_t>(threads));
    std::vector<std::thread> running;
    for (std::size_t thread = 0; thread < threads; ++thread) {
        running.emplace_back([&, thread] {
            all_are_here.arrive_and_wait();
            const Interruptions interruptions;
            for (int done = 0; !is_enough(done) && all_hold; ++done) {
                const int before = calls;
                if (!is_as_alone(thread)) all_hold = false;
                if (calls++ != before) ++meetings;
            }
        });
    }
    for (std::thread& thread : running) thread.join();
    return all_hold;
}
