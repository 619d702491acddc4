#include "candela/shape.h"

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

}  // namespace

std::vector<std::uint32_t> welded(ConstVec3Span position, std::size_t count) {
    boost::unordered_flat_map<Place, std::uint32_t, Hash> first_at;
    first_at.reserve(count);
    std::vector<std::uint32_t> first(count);
    for (std::size_t i = 0; i < count; ++i)
        first[i] = first_at.try_emplace(place_of(position[i]), static_cast<std::uint32_t>(i)).first->second;
    return first;
}

}  // namespace candela
