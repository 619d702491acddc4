#include "mesh_io/wedges.h"

#include <array>
#include <bit>
#include <boost/unordered/unordered_flat_map.hpp>
#include <cstddef>
#include <cstdint>

using candela::Vec3;

namespace mesh_io {

namespace {

/// A vertex, texture coordinates and a colour, bit by bit.
using Key = std::array<std::uint32_t, 6>;

struct KeyHash {
    std::size_t operator()(const Key& key) const {
        std::uint64_t h = 0x9e3779b97f4a7c15u;
        for (const std::uint32_t part : key) h = (h ^ part) * 0xff51afd7ed558ccdu, h ^= h >> 32;
        return h;
    }
};

std::uint32_t bits(float x) { return std::bit_cast<std::uint32_t>(x + 0.0f); }

}  // namespace

void split_by_wedges(const Wedges& wedges, Polygons& polygons, Surface& surface) {
    require_vertices(polygons, surface.position.size());
    const Surface whole = std::move(surface);
    surface = {};
    surface.losses = whole.losses;
    surface.notes = whole.notes;
    for (const Attribute& attribute : whole.attributes)
        surface.attributes.push_back({attribute.name, std::vector<Array<float>>(attribute.channels.size())});
    boost::unordered_flat_map<Key, std::uint32_t, KeyHash> vertex_of;
    vertex_of.reserve(polygons.corners.size());
    std::size_t corner = 0;
    for (std::size_t face = 0; face < polygons.ends.size(); ++face) {
        const Vec3 color = wedges.face_color.empty() ? Vec3{} : wedges.face_color.span()[face];
        for (; corner < polygons.ends[face]; ++corner) {
            const std::uint32_t vertex = polygons.corners[corner];
            const float u = wedges.u.empty() ? 0 : wedges.u[corner],
                        v = wedges.v.empty() ? 0 : wedges.v[corner];
            const auto [found, is_new] =
                vertex_of.try_emplace({vertex, bits(u), bits(v), bits(color.x), bits(color.y), bits(color.z)},
                                      static_cast<std::uint32_t>(surface.position.size()));
            polygons.corners[corner] = found->second;
            if (!is_new) continue;
            surface.position.push_back(whole.position.span()[vertex]);
            if (!whole.normal.empty()) surface.normal.push_back(whole.normal.span()[vertex]);
            for (std::size_t a = 0; a < whole.attributes.size(); ++a)
                for (std::size_t c = 0; c < whole.attributes[a].channels.size(); ++c)
                    surface.attributes[a].channels[c].push_back(whole.attributes[a].channels[c][vertex]);
            if (!wedges.face_color.empty()) {
                surface.color.push_back(color);
            } else if (!whole.color.empty()) {
                surface.color.push_back(whole.color.span()[vertex]);
            }
            if (!wedges.u.empty() || !whole.u.empty()) {
                surface.u.push_back(wedges.u.empty() ? whole.u[vertex] : u);
                surface.v.push_back(wedges.u.empty() ? whole.v[vertex] : v);
            }
        }
    }
}

}  // namespace mesh_io
