#include "fence.h"

#include <fmt/format.h>
#include <pthread.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <csetjmp>
#include <csignal>
#include <new>
#include <utility>
#include <vector>

namespace {

// Wide enough that an index off by a whole batch, or by a row of a picture, still lands in it.
constexpr std::size_t k_without_access = std::size_t{1} << 20;

std::vector<const Fenced*>& all_fenced() {
    static std::vector<const Fenced*> all;
    return all;
}

/// The call that is being watched.
struct Watch {
    sigjmp_buf back{};
    pthread_t thread{};
    const Fenced* trespassed = nullptr;
    bool is_write = false;
};
constinit Watch* watched = nullptr;

bool is_write([[maybe_unused]] const void* context) {
#if defined(__x86_64__)
    constexpr greg_t k_write = 2;  // a bit of a page fault's error code
    return (static_cast<const ucontext_t*>(context)->uc_mcontext.gregs[REG_ERR] & k_write) != 0;
#else
    return false;
#endif
}

void on_fault(int signal, siginfo_t* fault, void* context) {
    if (watched != nullptr && ::pthread_equal(watched->thread, ::pthread_self()) != 0) {
        for (const Fenced* const memory : all_fenced()) {
            if (!memory->is_beyond(fault->si_addr)) continue;
            watched->trespassed = memory;
            watched->is_write = is_write(context);
            ::siglongjmp(watched->back, 1);
        }
    }
    ::signal(signal, SIG_DFL);  // lets it happen again
}

/// Watches for faults while it exists.
class Watching {
  public:
    explicit Watching(Watch& watch) {
        struct sigaction action{};
        action.sa_sigaction = on_fault;
        action.sa_flags = SA_SIGINFO | SA_ONSTACK;
        ::sigemptyset(&action.sa_mask);
        ::sigaction(SIGSEGV, &action, &before_);
        watch.thread = ::pthread_self();
        watched = &watch;
    }
    Watching(const Watching&) = delete;
    Watching& operator=(const Watching&) = delete;
    ~Watching() {
        watched = nullptr;
        ::sigaction(SIGSEGV, &before_, nullptr);
    }

  private:
    struct sigaction before_{};
};

}  // namespace

Fenced::Fenced(std::string name, std::size_t bytes, Fence fence) : name_(std::move(name)), fence_(fence) {
    const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
    const std::size_t pages = (bytes + page - 1) / page * page;
    size_ = pages + k_without_access;
    void* const all = ::mmap(nullptr, size_, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (all == MAP_FAILED) throw std::bad_alloc();
    all_ = static_cast<std::byte*>(all);
    std::byte* const accessible = fence == Fence::before ? all_ + k_without_access : all_;
    if (pages > 0 && ::mprotect(accessible, pages, PROT_READ | PROT_WRITE) != 0) {
        ::munmap(all_, size_);
        throw std::bad_alloc();
    }
    memory_ = fence == Fence::before ? accessible : accessible + (pages - bytes);
    all_fenced().push_back(this);
}

Fenced::~Fenced() {
    std::erase(all_fenced(), this);
    ::munmap(all_, size_);
}

bool Fenced::is_beyond(const void* address) const {
    const std::byte* const begin = fence_ == Fence::before ? all_ : all_ + size_ - k_without_access;
    return address >= begin && address < begin + k_without_access;
}

std::string trespass_of(const std::function<void()>& call) {
    Watch watch;
    const Watching while_calling(watch);
    // This function creates no object with a destructor between here and the jump back.
    if (sigsetjmp(watch.back, 1) == 0) {  // NOLINT(cert-err52-cpp): a fault throws no exception
        call();
        return {};
    }
    return fmt::format(
        "{} {} {}", watch.is_write ? "writes" : "reads",
        watch.trespassed->fence() == Fence::after ? "past the end of" : "before the beginning of",
        watch.trespassed->name());
}
