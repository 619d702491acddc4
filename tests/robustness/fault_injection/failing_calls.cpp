// A library to preload: makes the nth call of one kind fail, as with a full disk, a broken disk, or without
// memory.
//
// CANDELA_FAIL_CALL names the kind, CANDELA_FAIL_AT is the number of the call that fails, counting from 1 (0:
// none), and CANDELA_FAIL_COUNT names a file for the number of calls. Calls are counted after the program's
// libraries are loaded.
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

const char* failing_call = nullptr;
long fail_at = 0;
constinit std::atomic<long> calls{0};

[[gnu::constructor]] void begin() {
    const char* const at = std::getenv("CANDELA_FAIL_AT");
    fail_at = at != nullptr ? std::atol(at) : 0;
    failing_call = std::getenv("CANDELA_FAIL_CALL");
}

// Uses only system calls: nothing here may be counted or fail.
[[gnu::destructor]] void end() {
    const char* const file = std::getenv("CANDELA_FAIL_COUNT");
    if (file == nullptr) return;
    std::array<char, 32> text{};
    const char* const last = std::to_chars(text.begin(), text.end(), calls.load()).ptr;
    const long descriptor = ::syscall(SYS_openat, AT_FDCWD, file, O_WRONLY | O_CREAT | O_TRUNC, 0600);
    if (descriptor < 0) return;
    ::syscall(SYS_write, descriptor, text.data(), last - text.data());
    ::syscall(SYS_close, descriptor);
}

bool fails(const char* call, int problem) {
    if (failing_call == nullptr || std::strcmp(failing_call, call) != 0) return false;
    if (++calls != fail_at) return false;
    errno = problem;
    return true;
}

template <class Function>
Function* next(const char* name) {
    return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" {

// Memory: glibc's own names, because looking up the next malloc needs memory.
void* __libc_malloc(size_t);
void* __libc_calloc(size_t, size_t);
void* __libc_realloc(void*, size_t);
void* __libc_memalign(size_t, size_t);

void* malloc(size_t size) noexcept { return fails("malloc", ENOMEM) ? nullptr : __libc_malloc(size); }
void* calloc(size_t count, size_t size) noexcept {
    return fails("malloc", ENOMEM) ? nullptr : __libc_calloc(count, size);
}
void* realloc(void* old, size_t size) noexcept {
    return fails("malloc", ENOMEM) ? nullptr : __libc_realloc(old, size);
}
void* memalign(size_t alignment, size_t size) noexcept {
    return fails("malloc", ENOMEM) ? nullptr : __libc_memalign(alignment, size);
}
void* aligned_alloc(size_t alignment, size_t size) noexcept { return memalign(alignment, size); }
int posix_memalign(void** result, size_t alignment, size_t size) noexcept {
    if (fails("malloc", ENOMEM)) return ENOMEM;
    *result = __libc_memalign(alignment, size);
    return *result != nullptr ? 0 : ENOMEM;
}

#define NEXT(name) next<decltype(name)>(#name)
#define OPEN(name)                                                      \
    int name(const char* path, int flags, ...) {                        \
        va_list more;                                                   \
        va_start(more, flags);                                          \
        const auto mode = static_cast<mode_t>(va_arg(more, int));       \
        va_end(more);                                                   \
        return fails("open", EIO) ? -1 : NEXT(name)(path, flags, mode); \
    }
OPEN(open)
OPEN(open64)

FILE* fopen(const char* path, const char* mode) {
    return fails("open", EIO) ? nullptr : NEXT(fopen)(path, mode);
}
FILE* fopen64(const char* path, const char* mode) {
    return fails("open", EIO) ? nullptr : NEXT(fopen64)(path, mode);
}

// Standard error takes the message.
ssize_t write(int descriptor, const void* data, size_t size) {
    return descriptor != STDERR_FILENO && fails("write", ENOSPC) ? -1 : NEXT(write)(descriptor, data, size);
}
ssize_t read(int descriptor, void* data, size_t size) {
    return fails("read", EIO) ? -1 : NEXT(read)(descriptor, data, size);
}
int fsync(int descriptor) { return fails("fsync", EIO) ? -1 : NEXT(fsync)(descriptor); }
int fchmod(int descriptor, mode_t mode) noexcept {
    return fails("fchmod", EPERM) ? -1 : NEXT(fchmod)(descriptor, mode);
}
int rename(const char* from, const char* to) noexcept {
    return fails("rename", EIO) ? -1 : NEXT(rename)(from, to);
}
int linkat(int from_folder, const char* from, int to_folder, const char* to, int flags) noexcept {
    return fails("linkat", EIO) ? -1 : NEXT(linkat)(from_folder, from, to_folder, to, flags);
}
// Whatever close() reports, the descriptor is closed.
int close(int descriptor) {
    const bool problem = fails("close", EIO);
    const int result = NEXT(close)(descriptor);
    if (!problem) return result;
    errno = EIO;
    return -1;
}

}  // extern "C"
