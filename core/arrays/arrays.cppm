// Arrays for batch loops.
module;

#include <cstddef>
#include <new>
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
