// Arrays for batch loops.
module;

#include <cstddef>
#include <cstdlib>
#include <new>
#include <utility>
#include <vector>

export module candela.arrays;

import candela.math;

export namespace candela {

/// Memory that begins at a cache line: a vector of 64 bytes that lies across two lines takes twice as long.
template <class T>
struct CacheLineAllocator {
    using value_type = T;
    static constexpr std::align_val_t k_line{64};

    CacheLineAllocator() = default;
    template <class Other>
    // NOLINTNEXTLINE(google-explicit-constructor): what the standard asks of an allocator
    CacheLineAllocator(const CacheLineAllocator<Other>&) noexcept {}

    T* allocate(std::size_t count) {
        if (count > static_cast<std::size_t>(-1) / sizeof(T)) throw std::bad_array_new_length();
        return static_cast<T*>(::operator new(count * sizeof(T), k_line));
    }
    void deallocate(T* memory, std::size_t) noexcept { ::operator delete(memory, k_line); }

    friend bool operator==(const CacheLineAllocator&, const CacheLineAllocator&) { return true; }
};

template <class T>
using AlignedVector = std::vector<T, CacheLineAllocator<T>>;

/// Memory that the system zeroes page by page, for whichever thread writes to a page first. What is
/// constructed without a value keeps the zeros, so a vector must not shrink and then grow in place.
template <class T>
struct ZeroedAllocator {
    using value_type = T;

    ZeroedAllocator() = default;
    template <class Other>
    // NOLINTNEXTLINE(google-explicit-constructor): what the standard asks of an allocator
    ZeroedAllocator(const ZeroedAllocator<Other>&) noexcept {}

    T* allocate(std::size_t count) {
        // NOLINTNEXTLINE(cppcoreguidelines-no-malloc): nothing else of the standard's gets such memory
        void* const memory = std::calloc(count, sizeof(T));
        if (memory == nullptr) throw std::bad_alloc();
        return static_cast<T*>(memory);
    }
    // NOLINTNEXTLINE(cppcoreguidelines-no-malloc)
    void deallocate(T* memory, std::size_t) noexcept { std::free(memory); }

    template <class U, class... Arguments>
    void construct(U* place, Arguments&&... arguments) {
        if constexpr (sizeof...(Arguments) > 0) ::new (place) U(std::forward<Arguments>(arguments)...);
    }

    friend bool operator==(const ZeroedAllocator&, const ZeroedAllocator&) { return true; }
};

template <class T>
using ZeroedVector = std::vector<T, ZeroedAllocator<T>>;

/// Three arrays of their own memory.
struct Vec3Arrays {
    AlignedVector<float> x, y, z;

    inline void resize(std::size_t count) {
        x.resize(count);
        y.resize(count);
        z.resize(count);
    }
    inline std::size_t size() const { return x.size(); }
    inline bool empty() const { return x.empty(); }
    inline Vec3Span span() { return {x.data(), y.data(), z.data()}; }
    inline ConstVec3Span span() const { return {x.data(), y.data(), z.data()}; }
};

}  // namespace candela
