#include "candela/parallel.h"
#include "candela/shape.h"

#include <algorithm>
#include <array>
#include <bit>
#include <boost/unordered/unordered_flat_map.hpp>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace candela {

namespace {

using Place = std::array<std::uint32_t, 3>;

Place place_of(Vec3 p) {
    const auto bits = [](float x) { return std::bit_cast<std::uint32_t>(x + 0.0f); };  // -0 is 0
    return {bits(p.x), bits(p.y), bits(p.z)};
}

struct Hash {
    std::size_t operator()(const Place& place) const {
        std::uint64_t h = 0x9e3779b97f4a7c15u;
        for (const std::uint32_t bits : place) h = (h ^ bits) * 0xff51afd7ed558ccdu, h ^= h >> 32;
        return h;
    }
};

/// Sorts vertices by a part of their places' hashes, each part small enough for its table to stay in the
/// cache; within a part they keep their order.
class Parts {
  public:
    static constexpr std::size_t k_count = 256;

    Parts(ConstVec3Span position, std::size_t count) : vertices_(count) {
        const std::size_t blocks = (count + k_block - 1) / k_block;
        std::vector<std::uint8_t> part_of(count);
        // How many vertices of each block belong to each part, and then where they go.
        std::vector<std::array<std::uint32_t, k_count>> place(blocks);
        const auto each_block = [&](auto visit) {
            parallel_for(blocks, 1, [&](std::size_t first, std::size_t last) {
                for (std::size_t block = first; block < last; ++block)
                    for (std::size_t i = block * k_block; i < std::min((block + 1) * k_block, count); ++i)
                        visit(block, i);
            });
        };
        each_block([&](std::size_t block, std::size_t i) {
            part_of[i] = static_cast<std::uint8_t>(Hash()(place_of(position[i])) >> 56);
            ++place[block][part_of[i]];
        });
        std::uint32_t next = 0;
        for (std::size_t part = 0; part < k_count; ++part) {
            begin_[part] = next;
            for (auto& block : place) {
                const std::uint32_t here = block[part];
                block[part] = next;
                next += here;
            }
        }
        begin_[k_count] = next;
        each_block([&](std::size_t block, std::size_t i) {
            vertices_[place[block][part_of[i]]++] = static_cast<std::uint32_t>(i);
        });
    }

    template <class Visit>
    void each_of(std::size_t part, Visit visit) const {
        for (std::uint32_t k = begin_[part]; k < begin_[part + 1]; ++k) visit(vertices_[k]);
    }
    std::size_t size(std::size_t part) const { return begin_[part + 1] - begin_[part]; }

  private:
    static constexpr std::size_t k_block = 65536;

    std::array<std::uint32_t, k_count + 1> begin_{};
    std::vector<std::uint32_t> vertices_;
};

}  // namespace

std::vector<std::uint32_t> welded(ConstVec3Span position, std::size_t count) {
    std::vector<std::uint32_t> first(count);
    const auto weld = [&](std::size_t expected, auto each) {
        boost::unordered_flat_map<Place, std::uint32_t, Hash> first_at;
        first_at.reserve(expected);
        each([&](std::uint32_t i) {
            first[i] = first_at.try_emplace(place_of(position[i]), i).first->second;
        });
    };
    constexpr std::size_t k_worth_parts = 200'000;
    if (count < k_worth_parts) {
        weld(count, [&](auto visit) {
            for (std::size_t i = 0; i < count; ++i) visit(static_cast<std::uint32_t>(i));
        });
        return first;
    }
    const Parts parts(position, count);
    parallel_for(Parts::k_count, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t part = begin; part < end; ++part)
            weld(parts.size(part), [&](auto visit) { parts.each_of(part, visit); });
    });
    return first;
}

}  // namespace candela
