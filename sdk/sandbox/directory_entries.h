// Reads directories in a signal handler: by system calls, without allocating.
#pragma once

#include <dirent.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstddef>
#include <cstring>

/// Calls visit(name) for the entries of an open directory, except "." and "..". Async-signal-safe if `visit`
/// is.
template <class Visit>
void for_each_entry(int directory, const Visit& visit) noexcept {
    // glibc also reads the kernel's data as dirent64.
    alignas(dirent64) char buffer[2048];
    for (;;) {
        const long size = ::syscall(SYS_getdents64, directory, buffer, sizeof buffer);
        if (size <= 0) return;
        for (long at = 0; at < size;) {
            const auto* const entry = reinterpret_cast<const dirent64*>(buffer + at);
            at += entry->d_reclen;
            if (std::strcmp(entry->d_name, ".") != 0 && std::strcmp(entry->d_name, "..") != 0)
                visit(entry->d_name);
        }
    }
}
