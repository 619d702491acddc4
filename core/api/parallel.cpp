#include "candela/parallel.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <map>
#include <mutex>
#include <utility>

#if defined(CANDELA_THREAD_SANITIZER)
extern "C" void __tsan_acquire(void* address);
extern "C" void __tsan_release(void* address);
#endif

namespace candela {

namespace {

/// Orders what happens before, during and after the work. oneTBB guarantees that order, but the library is
/// built without the thread sanitizer, which therefore has to be told. (This file is built without it as
/// well.)
class Handover {
  public:
    void give() {
#if defined(CANDELA_THREAD_SANITIZER)
        __tsan_release(this);
#endif
    }
    void take() {
#if defined(CANDELA_THREAD_SANITIZER)
        __tsan_acquire(this);
#endif
    }
};

/// Hands work to other threads and back; `run` must call its argument in each of them.
template <class Run>
void hand_over(Run run) {
    Handover to_workers, from_workers;
    to_workers.give();
    run([&](auto&& work) {
        to_workers.take();
        work();
        from_workers.give();
    });
    from_workers.take();
}

/// Whether parallel_for() stays on this thread.
thread_local bool is_alone = false;

class Alone {
  public:
    explicit Alone(bool alone) : before_(std::exchange(is_alone, alone)) {}
    ~Alone() { is_alone = before_; }
    Alone(const Alone&) = delete;
    Alone& operator=(const Alone&) = delete;

  private:
    bool before_;
};

/// The time to find oneTBB's libraries and start its threads.
constexpr double k_starting_ms = 1.5;
std::atomic<bool> has_started = false;

/// Arenas are kept, one per number of threads. Creating one takes time, and the memory that oneTBB aligns for
/// it is rarely reused (glibc bug 14581), so a program that keeps rendering would grow.
tbb::task_arena& arena_of(int threads) {
    // More threads than cores: unless explicitly allowed first, oneTBB reports on stderr that it ignores the
    // request.
    constexpr std::size_t k_most = 1024;
    if (threads > available_threads()) {
        static const auto* const allowed =
            new tbb::global_control(tbb::global_control::max_allowed_parallelism, k_most);
        static_cast<void>(allowed);
    }
    static std::mutex mutex;
    // Never destroyed, because other threads may still be working while the process exits.
    static auto& arenas = *new std::map<int, tbb::task_arena>;
    const std::scoped_lock lock(mutex);
    return arenas.try_emplace(threads, threads).first->second;
}

}  // namespace

int available_threads() noexcept { return std::max(tbb::info::default_concurrency(), 1); }

void with_threads(int threads, FunctionRef<> work, double milliseconds) {
    const bool is_worth_it = has_started || milliseconds >= k_starting_ms;
    if (threads == 0) threads = is_worth_it ? available_threads() : 1;
    const Alone alone(threads == 1);
    if (threads == 1) return work();
    has_started = true;
    tbb::task_arena& arena = arena_of(threads);
    hand_over([&](auto in_worker) { arena.execute([&] { in_worker([&] { work(); }); }); });
}

int current_threads() noexcept { return is_alone ? 1 : tbb::this_task_arena::max_concurrency(); }

void parallel_for(std::size_t count, std::size_t grain, FunctionRef<std::size_t, std::size_t> body) {
    if (count == 0) return;
    if (count <= grain || current_threads() == 1) return body(0, count);
    hand_over([&](auto in_worker) {
        tbb::parallel_for(
            tbb::blocked_range<std::size_t>(0, count, grain),
            [&](const tbb::blocked_range<std::size_t>& range) {
                in_worker([&] { body(range.begin(), range.end()); });
            },
            tbb::simple_partitioner{});
    });
}

}  // namespace candela
