module;

#include "candela/large_pages.h"

#include <cstddef>
#include <cstdlib>
#include <new>

module candela.util;

namespace candela {

void* zeroed_memory(std::size_t size) {
    // NOLINTNEXTLINE(cppcoreguidelines-no-malloc): only calloc offers such memory
    void* const memory = std::calloc(size, 1);
    if (memory == nullptr) throw std::bad_alloc();
    prefer_large_pages(memory, size);
    return memory;
}

}  // namespace candela
