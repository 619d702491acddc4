// Arrays of many megabytes.
#pragma once

#include "candela/large_pages.h"

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <vector>

namespace mesh_io {

/// Leaves new elements uninitialised, so that the threads that fill an array of a hundred megabytes are the
/// first to touch it, in large pages.
template <class T>
struct UninitializedAllocator : std::allocator<T> {
    template <class U>
    struct rebind {  // NOLINT(readability-identifier-naming): the standard's name
        using other = UninitializedAllocator<U>;
    };
    static constexpr std::size_t k_large = std::size_t{4} << 20;  // bytes
    T* allocate(std::size_t count) {
        if (count < k_large / sizeof(T)) return std::allocator<T>::allocate(count);
        if (count > static_cast<std::size_t>(-1) / sizeof(T)) throw std::bad_array_new_length();
        // NOLINTNEXTLINE(cppcoreguidelines-no-malloc): operator new offers no way to prepare untouched pages
        void* const memory = std::malloc(count * sizeof(T));
        if (memory == nullptr) throw std::bad_alloc();
        candela::prefer_large_pages(memory, count * sizeof(T));
        return static_cast<T*>(memory);
    }
    void deallocate(T* memory, std::size_t count) noexcept {
        if (count < k_large / sizeof(T)) return std::allocator<T>::deallocate(memory, count);
        std::free(memory);  // NOLINT(cppcoreguidelines-no-malloc)
    }
    template <class U>
    void construct(U*) noexcept {}
    template <class U, class... Arguments>
    void construct(U* place, Arguments&&... arguments) {
        ::new (static_cast<void*>(place)) U(static_cast<Arguments&&>(arguments)...);
    }
};

/// A vector whose resize() does not initialise.
template <class T>
using Array = std::vector<T, UninitializedAllocator<T>>;

}  // namespace mesh_io
