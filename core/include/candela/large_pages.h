// Memory for arrays of many megabytes.
#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <cstdint>

namespace candela {

/// Asks the system for two-megabyte pages where whole ones fit into `size` bytes at `memory`: finding forty
/// small pages takes as long as zeroing a large one. This is only advice: if no large page is available, the
/// system uses small ones. Call it before the memory is touched.
inline void prefer_large_pages(void* memory, std::size_t size) noexcept {
    constexpr std::size_t k_large_page = std::size_t{2} << 20;
    const std::size_t before = -reinterpret_cast<std::uintptr_t>(memory) % k_large_page;
    if (size >= before + k_large_page)
        ::madvise(static_cast<std::byte*>(memory) + before, (size - before) / k_large_page * k_large_page,
                  MADV_HUGEPAGE);
}

}  // namespace candela
