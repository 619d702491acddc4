module;

#include "candela/plugin/export.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>
#include <utility>
#include <vector>

export module candela.util:arrays;

import candela.api;

export namespace candela {

/// The number of floats in the widest vectors. Loops over a multiple of it have no scalar remainder.
inline constexpr std::size_t k_lanes = 16;

/// `count` rounded up to whole vectors.
constexpr std::size_t whole_vectors(std::size_t count) { return (count + k_lanes - 1) / k_lanes * k_lanes; }

/// Returns zeroed memory, which std::free() releases. The system zeroes it page by page, for whichever thread
/// touches a page first; two megabytes and more are in large pages, if available, because finding forty small
/// ones takes as long as zeroing one of two megabytes. Throws std::bad_alloc. Any thread.
CANDELA_EXPORT void* zeroed_memory(std::size_t size);

/// Memory aligned to cache lines, because accessing a 64-byte vector that straddles two lines takes twice as
/// long. Elements constructed without a value keep the memory's contents: zeros, or the old values if a
/// vector shrank and grew again.
template <class T>
struct CacheLineAllocator {
    using value_type = T;
    static constexpr std::size_t k_line = 64;

    CacheLineAllocator() = default;
    template <class Other>
    // NOLINTNEXTLINE(google-explicit-constructor): what the standard asks of an allocator
    CacheLineAllocator(const CacheLineAllocator<Other>&) noexcept {}

    T* allocate(std::size_t count) {
        if (count > (static_cast<std::size_t>(-1) - 2 * k_line) / sizeof(T))
            throw std::bad_array_new_length();
        std::size_t room = count * sizeof(T) + k_line;
        void* const whole = zeroed_memory(room + sizeof whole);
        void* line = static_cast<std::byte*>(whole) + sizeof whole;
        std::align(k_line, count * sizeof(T), line, room);
        static_cast<void**>(line)[-1] = whole;
        return static_cast<T*>(line);
    }
    // NOLINTNEXTLINE(cppcoreguidelines-no-malloc): as zeroed_memory() says
    void deallocate(T* memory, std::size_t) noexcept { std::free(reinterpret_cast<void**>(memory)[-1]); }

    template <class U, class... Arguments>
    void construct(U* place, Arguments&&... arguments) {
        if constexpr (sizeof...(Arguments) > 0) ::new (place) U(std::forward<Arguments>(arguments)...);
    }

    friend bool operator==(const CacheLineAllocator&, const CacheLineAllocator&) { return true; }
};

template <class T>
using AlignedVector = std::vector<T, CacheLineAllocator<T>>;

/// Three arrays that own their memory.
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

/// Sixteen records of four floats or integers, column by column, inside a batch loop. Fetching each record as
/// a whole, wherever it is, and transposing them takes far fewer operations and cache lines than fetching
/// every number by itself.
struct Columns {
    alignas(64) float real[4][k_lanes];

    [[gnu::always_inline]] inline std::int32_t integer(std::size_t column, std::size_t record) const {
        return std::bit_cast<std::int32_t>(real[column][record]);
    }

    /// `record(i)` is the address of record i: 16 bytes.
    template <class Record>
    [[gnu::always_inline]] inline void gather(Record record) {
        Four records[k_lanes];
        for (std::size_t i = 0; i < k_lanes; ++i) std::memcpy(&records[i], record(i), sizeof(Four));
        transpose(records);
    }

  private:
    using Four = float __attribute__((vector_size(16)));

    // Not inside gather(): clang 22 crashes on a template whose variables are initialised by others.
    [[gnu::always_inline]] inline void transpose(const Four (&records)[k_lanes]) {
        using Eight = float __attribute__((vector_size(32)));
        using Sixteen = float __attribute__((vector_size(64)));
        // Row r consists of records r, r + 4, r + 8 and r + 12: transposing quarter by quarter puts them all
        // in order.
        Sixteen row[4];
        for (std::size_t r = 0; r < 4; ++r) {
            const Eight ab = __builtin_shufflevector(records[r], records[r + 4], 0, 1, 2, 3, 4, 5, 6, 7);
            const Eight cd = __builtin_shufflevector(records[r + 8], records[r + 12], 0, 1, 2, 3, 4, 5, 6, 7);
            row[r] = __builtin_shufflevector(ab, cd, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
        }
        const Sixteen low_01 =
            __builtin_shufflevector(row[0], row[1], 0, 16, 1, 17, 4, 20, 5, 21, 8, 24, 9, 25, 12, 28, 13, 29);
        const Sixteen high_01 = __builtin_shufflevector(row[0], row[1], 2, 18, 3, 19, 6, 22, 7, 23, 10, 26,
                                                        11, 27, 14, 30, 15, 31);
        const Sixteen low_23 =
            __builtin_shufflevector(row[2], row[3], 0, 16, 1, 17, 4, 20, 5, 21, 8, 24, 9, 25, 12, 28, 13, 29);
        const Sixteen high_23 = __builtin_shufflevector(row[2], row[3], 2, 18, 3, 19, 6, 22, 7, 23, 10, 26,
                                                        11, 27, 14, 30, 15, 31);
        const Sixteen columns[4] = {
            __builtin_shufflevector(low_01, low_23, 0, 1, 16, 17, 4, 5, 20, 21, 8, 9, 24, 25, 12, 13, 28, 29),
            __builtin_shufflevector(low_01, low_23, 2, 3, 18, 19, 6, 7, 22, 23, 10, 11, 26, 27, 14, 15, 30,
                                    31),
            __builtin_shufflevector(high_01, high_23, 0, 1, 16, 17, 4, 5, 20, 21, 8, 9, 24, 25, 12, 13, 28,
                                    29),
            __builtin_shufflevector(high_01, high_23, 2, 3, 18, 19, 6, 7, 22, 23, 10, 11, 26, 27, 14, 15, 30,
                                    31)};
        std::memcpy(real, columns, sizeof real);
    }
};

}  // namespace candela
