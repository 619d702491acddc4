// How much memory there still is: what does not fit is an error with figures, not the end of the process.
module;

#include "candela/api.h"

#include <cstdint>
#include <string_view>

export module candela.memory;

import candela.diagnostics;

export namespace candela {

/// Bytes that this process can still get: of the machine's memory, of its control group's, and within its
/// limit of address space (ulimit -v). The largest number where nothing says. Any thread.
CANDELA_API std::uint64_t available_memory();

/// Throws Error (failure) where `bytes` more do not fit: "`what` needs 12.9 GB of memory; 3.1 GB are
/// available". Small needs are added up and looked at from time to time, so that it may be called often. Any
/// thread.
CANDELA_API void require_memory(std::uint64_t bytes, std::string_view what);

}  // namespace candela
