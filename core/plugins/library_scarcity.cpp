module;

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <mutex>
#include <sstream>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

module candela.plugins;

namespace candela {

namespace {

std::size_t address_space_used() {
    std::ifstream pages("/proc/self/statm");
    std::size_t used = 0;
    pages >> used;
    return used * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

/// Exits with 0 if the library can be loaded and `is_enough` returns true for what is left then; also if
/// loading fails for another reason, which the caller will find.
template <class IsEnough>
[[noreturn]] void try_to_load(const std::filesystem::path& library, const IsEnough& is_enough) {
    const rlimit no_core{0, 0};
    ::setrlimit(RLIMIT_CORE, &no_core);
    if (const int nowhere = ::open("/dev/null", O_RDWR); nowhere >= 0) {
        for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(nowhere, standard);
    }
    if (::dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL) == nullptr) ::_exit(0);
    ::_exit(is_enough() ? 0 : 1);
}

/// Loads the library in a child process first. If no child can be started, returns true.
template <class IsEnough>
bool can_load(const std::filesystem::path& library, std::chrono::seconds longest, const IsEnough& is_enough) {
    const pid_t child = ::fork();
    if (child < 0) return true;
    if (child == 0) try_to_load(library, is_enough);
    // Some libraries deadlock when a thread fails to start.
    constexpr std::chrono::milliseconds k_pause{5};
    const auto until = std::chrono::steady_clock::now() + longest;
    int status = 0;
    for (pid_t ended = 0; ended != child;) {
        ended = ::waitpid(child, &status, WNOHANG);
        if (ended < 0 && errno != EINTR) return true;
        if (ended != 0) continue;
        if (std::chrono::steady_clock::now() > until) ::kill(child, SIGKILL);
        std::this_thread::sleep_for(k_pause);
    }
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

/// For libraries that use several threads: some that they start when loaded, and two pools of one thread per
/// processor.
unsigned wanted_threads() { return 8 + 2 * std::thread::hardware_concurrency(); }

/// The number of tasks of all users together, hence at least this user's.
std::uint64_t running_tasks() {
    std::ifstream load("/proc/loadavg");
    std::string word;
    for (int i = 0; i < 4; ++i) load >> word;
    std::uint64_t tasks = 0;  // the fourth word is "3/412": 3 are running, 412 exist
    std::istringstream(word.substr(std::min(word.find('/') + 1, word.size()))) >> tasks;
    return tasks;
}

/// Whether a limit on threads may be near; takes next to no time.
bool is_thread_limit_near() {
    rlimit limit{};
    const bool has_limit = ::getrlimit(RLIMIT_NPROC, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
    if (has_limit && limit.rlim_cur < running_tasks() + wanted_threads()) return true;
    std::uint64_t most = 0, current = 0;
    return std::ifstream("/sys/fs/cgroup/pids.max") >> most &&
           std::ifstream("/sys/fs/cgroup/pids.current") >> current && most < current + wanted_threads();
}

/// Whether so many threads can run at once.
bool can_start(unsigned count) {
    std::mutex mutex;
    std::condition_variable end;
    bool is_over = false;
    std::vector<std::thread> threads;
    threads.reserve(count);
    bool all_started = true;
    try {
        while (threads.size() < count)
            threads.emplace_back([&] {
                std::unique_lock lock(mutex);
                end.wait(lock, [&] { return is_over; });
            });
    } catch (const std::system_error&) {
        all_started = false;
    }
    {
        const std::lock_guard lock(mutex);
        is_over = true;
    }
    end.notify_all();
    for (std::thread& thread : threads) thread.join();
    return all_started;
}

bool is_single_threaded() {
    std::error_code problem;
    const std::filesystem::directory_iterator threads("/proc/self/task", problem);
    return problem || std::distance(begin(threads), end(threads)) <= 1;
}

}  // namespace

bool is_address_space_scarce() {
    constexpr rlim_t k_plenty = rlim_t{1} << 30;  // three times what OpenImageIO and its libraries take
    rlimit limit{};
    return ::getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY &&
           limit.rlim_cur < address_space_used() + k_plenty;
}

bool lacks_address_space(const std::filesystem::path& library) {
    if (!is_address_space_scarce()) return false;
    // A quarter of what it takes must be left for its work.
    return !can_load(library, std::chrono::seconds(20), [before = address_space_used()] {
        const std::size_t after = address_space_used();
        const std::size_t for_work = after > before ? (after - before) / 4 : 0;
        return for_work == 0 ||
               ::mmap(nullptr, for_work, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0) != MAP_FAILED;
    });
}

bool lacks_threads(const std::filesystem::path& library) {
    static const bool k_is_scarce = is_thread_limit_near() && !can_start(wanted_threads());
    return k_is_scarce && !can_load(library, std::chrono::seconds(5), is_single_threaded);
}

}  // namespace candela
