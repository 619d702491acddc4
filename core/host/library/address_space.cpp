module;

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <thread>

module candela.library;

namespace candela {

namespace {

std::size_t address_space_used() {
    std::ifstream pages("/proc/self/statm");
    std::size_t used = 0;
    pages >> used;
    return used * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

/// Ends with 0 if the library can be loaded, and as much as a quarter of what it takes is left for its work;
/// also if it is not loaded for another reason, which the caller will find.
[[noreturn]] void try_to_load(const std::filesystem::path& library) {
    const rlimit no_core{0, 0};
    ::setrlimit(RLIMIT_CORE, &no_core);
    if (const int nowhere = ::open("/dev/null", O_RDWR); nowhere >= 0) {
        for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(nowhere, standard);
    }
    const std::size_t before = address_space_used();
    if (::dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL) == nullptr) ::_exit(0);
    const std::size_t after = address_space_used();
    const std::size_t for_work = after > before ? (after - before) / 4 : 0;
    if (for_work > 0 &&
        ::mmap(nullptr, for_work, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0) == MAP_FAILED)
        ::_exit(1);
    ::_exit(0);
}

}  // namespace

bool is_address_space_scarce() {
    constexpr rlim_t k_plenty = rlim_t{1} << 30;  // thrice what OpenImageIO and its libraries take
    rlimit limit{};
    return ::getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY &&
           limit.rlim_cur < address_space_used() + k_plenty;
}

bool lacks_address_space(const std::filesystem::path& library) {
    if (!is_address_space_scarce()) return false;
    const pid_t child = ::fork();
    if (child < 0) return false;  // then it is tried without
    if (child == 0) try_to_load(library);
    // Some libraries wait for ever for a thread that they could not start.
    constexpr std::chrono::seconds k_longest{20};
    constexpr std::chrono::milliseconds k_pause{5};
    const auto until = std::chrono::steady_clock::now() + k_longest;
    int status = 0;
    for (pid_t ended = 0; ended != child;) {
        ended = ::waitpid(child, &status, WNOHANG);
        if (ended < 0 && errno != EINTR) return false;
        if (ended != 0) continue;
        if (std::chrono::steady_clock::now() > until) ::kill(child, SIGKILL);
        std::this_thread::sleep_for(k_pause);
    }
    return !WIFEXITED(status) || WEXITSTATUS(status) != 0;
}

}  // namespace candela
