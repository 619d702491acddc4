#include "sandbox.h"

#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <vector>

namespace {

// Sanitizers have terabytes of shadow memory, little of which is used.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define CANDELA_HAS_SHADOW_MEMORY
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define CANDELA_HAS_SHADOW_MEMORY
#endif
#if __has_feature(undefined_behavior_sanitizer)
#define CANDELA_CHECKS_TYPES
#endif
#endif
#if defined(CANDELA_HAS_SHADOW_MEMORY)
constexpr bool k_has_shadow_memory = true;
#else
constexpr bool k_has_shadow_memory = false;
#endif

#if defined(__x86_64__)
constexpr __u32 k_architecture = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr __u32 k_architecture = AUDIT_ARCH_AARCH64;
#else
#error "system calls are allowed by number, so the architecture must be known here"
#endif

constexpr rlim_t k_mib = rlim_t{1024} * 1024;

void limit(int what, rlim_t soft, rlim_t hard) {
    rlimit now{};
    ::getrlimit(static_cast<__rlimit_resource>(what), &now);
    const rlimit wanted{.rlim_cur = std::min(soft, now.rlim_max), .rlim_max = std::min(hard, now.rlim_max)};
    if (::setrlimit(static_cast<__rlimit_resource>(what), &wanted) != 0) ::_exit(k_cannot_be_confined);
}

/// The size of this process, in bytes.
rlim_t size_of_address_space() {
    unsigned long pages = 0;
    std::FILE* const file = std::fopen("/proc/self/statm", "r");
    if (file == nullptr || std::fscanf(file, "%lu", &pages) != 1) ::_exit(k_cannot_be_confined);
    std::fclose(file);
    return pages * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE));
}

/// System calls for memory, time, and exiting.
constexpr std::array k_allowed = {
    SYS_brk,
    SYS_mmap,
    SYS_munmap,
    SYS_mremap,
    SYS_madvise,
    SYS_mprotect,
    SYS_futex,
    SYS_sched_yield,
    SYS_clock_gettime,
    SYS_rt_sigreturn,
    SYS_exit_group,
    SYS_exit,
#if defined(CANDELA_HAS_SHADOW_MEMORY)
    // At exit, AddressSanitizer asks for the signal stack.
    SYS_sigaltstack,
#endif
#if defined(CANDELA_CHECKS_TYPES)
    // UndefinedBehaviorSanitizer finds out whether an address is readable by writing from it into a pipe.
    SYS_pipe2,
    SYS_write,
    SYS_close,
#endif
};

}  // namespace

void limit_compiling() {
    constexpr rlim_t k_seconds = 30;
    limit(RLIMIT_CPU, k_seconds, k_seconds + 1);
    limit(RLIMIT_FSIZE, 64 * k_mib, 64 * k_mib);
    limit(RLIMIT_CORE, 0, 0);
    if (!k_has_shadow_memory) limit(RLIMIT_AS, 4096 * k_mib, 4096 * k_mib);
}

void confine(std::size_t room, unsigned seconds) {
    rusage used{};
    ::getrusage(RUSAGE_SELF, &used);
    const auto until = static_cast<rlim_t>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) + seconds + 1;
    limit(RLIMIT_CPU, until, until + 1);
    limit(RLIMIT_CORE, 0, 0);
    if (!k_has_shadow_memory) {
        const rlim_t all = size_of_address_space() + room;
        limit(RLIMIT_AS, all, all);
    }
    limit(RLIMIT_FSIZE, 0, 0);

    std::vector<sock_filter> program = {
        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, arch)),
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, k_architecture, 1, 0),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_KILL_PROCESS),
        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
    };
    for (const long call : k_allowed) {
        program.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<__u32>(call), 0, 1));
        program.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW));
    }
    program.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_KILL_PROCESS));
    const sock_fprog all = {static_cast<unsigned short>(program.size()), program.data()};
    if (::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0 ||
        ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &all) != 0)
        ::_exit(k_cannot_be_confined);
}
