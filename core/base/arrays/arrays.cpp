module;

#include <sys/mman.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>

module candela.arrays;

namespace candela {

void* zeroed_memory(std::size_t size) {
    // NOLINTNEXTLINE(cppcoreguidelines-no-malloc): only calloc offers such memory
    void* const memory = std::calloc(size, 1);
    if (memory == nullptr) throw std::bad_alloc();
    constexpr std::size_t k_large_page = std::size_t{2} << 20;
    const std::size_t before = -reinterpret_cast<std::uintptr_t>(memory) % k_large_page;
    // Only advice: a system that has no large page at hand uses small ones.
    if (size >= before + k_large_page)
        ::madvise(static_cast<std::byte*>(memory) + before, (size - before) / k_large_page * k_large_page,
                  MADV_HUGEPAGE);
    return memory;
}

}  // namespace candela
