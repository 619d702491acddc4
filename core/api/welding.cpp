#include "candela/large_pages.h"
#include "candela/parallel.h"
#include "candela/shape.h"

#include <algorithm>
#include <array>
#include <bit>
#include <boost/unordered/unordered_flat_map.hpp>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace candela {

namespace {

using PositionBits = std::array<std::uint32_t, 3>;

PositionBits bits_of(Vec3 p) {
    const auto bits = [](float x) { return std::bit_cast<std::uint32_t>(x + 0.0f); };  // -0 is 0
    return {bits(p.x), bits(p.y), bits(p.z)};
}

struct Hash {
    std::size_t operator()(const PositionBits& place) const {
        std::uint64_t h = 0x9e3779b97f4a7c15u;
        for (const std::uint32_t bits : place) h = (h ^ bits) * 0xff51afd7ed558ccdu, h ^= h >> 32;
        return h;
    }
};

/// Sorts vertices and their positions by a part of the positions' hashes, so that the table of each part is
/// small enough for the cache. Within a part the order is kept.
class HashBuckets {
  public:
    static constexpr std::size_t k_count = 256;

    struct Vertex {
        PositionBits place;
        std::uint32_t number;
    };

    HashBuckets(ConstVec3Span position, std::size_t count)
        : vertices_(std::make_unique_for_overwrite<Vertex[]>(count)) {
        prefer_large_pages(vertices_.get(), count * sizeof(Vertex));
        const std::size_t blocks = (count + k_block - 1) / k_block;
        const auto part_of = std::make_unique_for_overwrite<std::uint8_t[]>(count);
        // The number of vertices of each block in each part, and then their destinations.
        std::vector<std::array<std::uint32_t, k_count>> goal(blocks);
        const auto each_block = [&](auto visit) {
            parallel_for(blocks, 1, [&](std::size_t first, std::size_t last) {
                for (std::size_t block = first; block < last; ++block)
                    for (std::size_t i = block * k_block; i < std::min((block + 1) * k_block, count); ++i)
                        visit(goal[block], i);
            });
        };
        each_block([&](auto& counts, std::size_t i) {
            part_of[i] = static_cast<std::uint8_t>(Hash()(bits_of(position[i])) >> 56);
            ++counts[part_of[i]];
        });
        std::uint32_t next = 0;
        for (std::size_t part = 0; part < k_count; ++part) {
            begin_[part] = next;
            for (auto& block : goal) {
                const std::uint32_t here = block[part];
                block[part] = next;
                next += here;
            }
        }
        begin_[k_count] = next;
        each_block([&](auto& goals, std::size_t i) {
            vertices_[goals[part_of[i]]++] = {bits_of(position[i]), static_cast<std::uint32_t>(i)};
        });
    }

    std::span<const Vertex> operator[](std::size_t part) const {
        return {vertices_.get() + begin_[part], begin_[part + 1] - begin_[part]};
    }

  private:
    static constexpr std::size_t k_block = 65536;

    std::array<std::uint32_t, k_count + 1> begin_{};
    std::unique_ptr<Vertex[]> vertices_;
};

/// Finds the first vertex at each position. Open addressing in one array, which stays in the cache.
class PlaceTable {
  public:
    void run(std::span<const HashBuckets::Vertex> vertices, std::uint32_t* first) {
        constexpr std::uint32_t k_free = 0xffff'ffffu;
        const std::size_t mask = std::bit_ceil(2 * vertices.size() + 1) - 1;
        slots_.assign(mask + 1, k_free);
        for (std::uint32_t i = 0; i < vertices.size(); ++i) {
            const HashBuckets::Vertex& v = vertices[i];
            for (std::size_t at = Hash()(v.place) & mask;; at = (at + 1) & mask) {
                std::uint32_t& slot = slots_[at];
                if (slot == k_free) slot = i;
                if (slot != i && vertices[slot].place != v.place) continue;
                first[v.number] = vertices[slot].number;
                break;
            }
        }
    }

  private:
    std::vector<std::uint32_t> slots_;
};

}  // namespace

std::vector<std::uint32_t> welded(ConstVec3Span position, std::size_t count) {
    using FirstAt = boost::unordered_flat_map<PositionBits, std::uint32_t, Hash>;
    std::vector<std::uint32_t> first(count);
    constexpr std::size_t k_worth_parts = 200'000;
    if (count < k_worth_parts) {
        FirstAt first_at;
        first_at.reserve(count);
        for (std::size_t i = 0; i < count; ++i)
            first[i] =
                first_at.try_emplace(bits_of(position[i]), static_cast<std::uint32_t>(i)).first->second;
        return first;
    }
    const HashBuckets parts(position, count);
    parallel_for(HashBuckets::k_count, 1, [&](std::size_t begin, std::size_t end) {
        PlaceTable table;
        for (std::size_t part = begin; part < end; ++part) table.run(parts[part], first.data());
    });
    return first;
}

}  // namespace candela
