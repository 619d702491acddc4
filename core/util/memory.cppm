// Available-memory checks: too large a request is an error with figures, not the end of the process.
module;

#include "candela/plugin/export.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

export module candela.util:memory;

import :diagnostics;

export namespace candela {

/// The number of bytes that this process can still allocate, given the machine's memory, its control group's,
/// and its address-space limit (ulimit -v). The largest number if no limit is known. Any thread.
CANDELA_EXPORT std::uint64_t available_memory();

/// The memory that is left to a process by its control groups, which are mounted at `mount` (/sys/fs/cgroup)
/// and named by the file `membership` (/proc/self/cgroup): version 2 (memory.max, memory.high) and version 1,
/// with the limits of all groups above. Cached files do not count as used. The largest number if there is no
/// limit. Any thread.
CANDELA_EXPORT std::uint64_t memory_left_by_control_groups(const std::filesystem::path& mount,
                                                           const std::filesystem::path& membership);

/// Why something that needs much memory was not begun; what comes after it would hardly fit either.
class CANDELA_EXPORT MemoryShortage : public Error {
  public:
    explicit MemoryShortage(const std::string& message) : Error(ErrorCategory::failure, message) {}
};

/// Throws MemoryShortage if another `bytes` do not fit: "`what` needs 12.9 GB of memory; 3.1 GB are
/// available". Small amounts are accumulated and checked from time to time, so calling it often is cheap. Any
/// thread.
CANDELA_EXPORT void require_memory(std::uint64_t bytes, std::string_view what);

}  // namespace candela
