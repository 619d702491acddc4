#include "tangents.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

using candela::Vec3;

namespace mesh {

namespace {

Vec3 unit(Vec3 v) {
    const float size = length(v);
    return size > 0 && std::isfinite(size) ? (1 / size) * v : Vec3{};
}
Vec3 in_plane(Vec3 v, Vec3 normal) { return unit(v - dot(normal, v) * normal); }

/// Attributes by which vertices are the same.
struct VertexKey {
    std::array<std::uint32_t, 8> bits;
    friend bool operator==(const VertexKey&, const VertexKey&) = default;
};
struct VertexHash {
    std::size_t operator()(const VertexKey& key) const noexcept {
        std::uint64_t hash = 0xcbf2'9ce4'8422'2325u;  // FNV-1a
        for (const std::uint32_t part : key.bits) hash = (hash ^ part) * 0x100'0000'01b3u;
        return static_cast<std::size_t>(hash ^ (hash >> 32));
    }
};

/// Derivatives along a triangle.
struct Frame {
    Vec3 dpdu{}, dpdv{};
    bool is_sound = false;     // it has an area in space and in the texture
    bool is_mirrored = false;  // in the texture
};

class Builder {
  public:
    Builder(const mesh_io::Surface& surface, const SplitVertices& split)
        : surface_(surface),
          vertices_(split.indices.empty() ? surface.position.size() : split.source.size()),
          source_(split.source),
          indices_(split.indices.empty() ? surface.indices : split.indices) {
        result_.vertices.source = split.source;
        result_.vertices.group = split.group;
        result_.vertices.indices = indices_;
    }

    Tangents run() {
        find_normals();
        find_frames();
        weld();
        sort_corners();
        for (mesh_io::Vectors* const all : {&result_.dpdu, &result_.dpdv}) {
            all->resize(vertices_);
            for (mesh_io::Array<float>* const numbers : {&all->x, &all->y, &all->z})
                std::ranges::fill(*numbers, 0.0f);
        }
        last_.resize(vertices_);
        for (std::size_t i = 0; i + 1 < begin_.size(); ++i) treat(here(i));
        return std::move(result_);
    }

  private:
    std::uint32_t source(std::uint32_t vertex) const { return source_.empty() ? vertex : source_[vertex]; }
    Vec3 position(std::uint32_t vertex) const { return surface_.position.span()[source(vertex)]; }
    Vec3 at_corner(std::size_t corner) const { return position(indices_[corner]); }
    std::uint32_t group(std::uint32_t vertex) const {
        return result_.vertices.group.empty() ? vertex : result_.vertices.group[vertex];
    }
    static std::size_t next(std::size_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }
    static std::size_t previous(std::size_t corner) { return corner % 3 == 0 ? corner + 2 : corner - 1; }

    void find_normals() {
        normal_.resize(vertices_);
        std::vector<Vec3> sums(vertices_);
        for (std::size_t corner = 0; corner < indices_.size(); corner += 3) {
            const Vec3 a = at_corner(corner);
            const Vec3 area = cross(at_corner(corner + 1) - a, at_corner(corner + 2) - a);
            for (std::size_t k = 0; k < 3; ++k) {
                Vec3& sum = sums[group(indices_[corner + k])];
                sum = sum + area;
            }
        }
        for (std::uint32_t v = 0; v < vertices_; ++v) {
            const Vec3 own = surface_.normal.empty() ? Vec3{} : unit(surface_.normal.span()[source(v)]);
            normal_[v] = own != Vec3{} ? own : unit(sums[group(v)]);
        }
    }

    void find_frames() {
        frames_.resize(indices_.size() / 3);
        for (std::size_t t = 0; t < frames_.size(); ++t) {
            const auto change = [&](const mesh_io::Array<float>& along, std::size_t k) {
                return along[source(indices_[3 * t + k])] - along[source(indices_[3 * t])];
            };
            const Vec3 a = at_corner(3 * t), p = at_corner(3 * t + 1) - a, q = at_corner(3 * t + 2) - a;
            const float pu = change(surface_.u, 1), pv = change(surface_.v, 1), qu = change(surface_.u, 2),
                        qv = change(surface_.v, 2);
            const float area = pu * qv - qu * pv;
            const Vec3 du = (1 / area) * (qv * p - pv * q), dv = (1 / area) * (pu * q - qu * p);
            const float size = dot(du, du) * dot(dv, dv) * length(cross(p, q));
            frames_[t] = {du, dv, std::isfinite(size) && size > 0, area < 0};
        }
    }

    /// Numbers vertices so that equal ones have the same number.
    void weld() {
        std::unordered_map<VertexKey, std::uint32_t, VertexHash> known;
        known.reserve(vertices_);
        welded_.resize(vertices_);
        for (std::uint32_t v = 0; v < vertices_; ++v) {
            const Vec3 p = position(v), n = normal_[v];
            VertexKey key{};
            std::ranges::transform(
                std::array{p.x, p.y, p.z, n.x, n.y, n.z, surface_.u[source(v)], surface_.v[source(v)]},
                key.bits.begin(), [](float x) { return std::bit_cast<std::uint32_t>(x + 0.0f); });
            welded_[v] = known.try_emplace(key, static_cast<std::uint32_t>(known.size())).first->second;
        }
        begin_.resize(known.size() + 1);
    }

    void sort_corners() {
        for (const std::uint32_t v : indices_) ++begin_[welded_[v] + 1];
        std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
        corners_.resize(indices_.size());
        std::vector<std::uint32_t> at(begin_.begin(), begin_.end() - 1);
        for (std::uint32_t corner = 0; corner < indices_.size(); ++corner)
            corners_[at[welded_[indices_[corner]]]++] = corner;
    }
    std::span<const std::uint32_t> here(std::size_t welded) const {
        return std::span(corners_).subspan(begin_[welded], begin_[welded + 1] - begin_[welded]);
    }

    /// Divides the corners of a welded vertex into groups that share a frame, and finds the frames.
    void treat(std::span<const std::uint32_t> corners) {
        parent_.resize(corners.size());
        std::iota(parent_.begin(), parent_.end(), 0u);
        edges_.clear();
        for (std::uint32_t i = 0; i < corners.size(); ++i) {
            for (const std::size_t other : {next(corners[i]), previous(corners[i])})
                edges_.emplace_back(welded_[indices_[other]], i);
        }
        std::ranges::sort(edges_);
        const auto frame = [&](std::uint32_t i) -> const Frame& { return frames_[corners[i] / 3]; };
        for (std::size_t k = 1; k < edges_.size(); ++k) {
            const auto [to, i] = edges_[k];
            const auto [before, j] = edges_[k - 1];
            if (to == before && frame(i).is_sound && frame(j).is_sound &&
                frame(i).is_mirrored == frame(j).is_mirrored)
                parent_[root(i)] = root(j);
        }
        // A triangle without a frame of its own shares a neighbour's, or any.
        for (std::size_t k = 1; k < edges_.size(); ++k) {
            const auto [to, i] = edges_[k];
            const auto [before, j] = edges_[k - 1];
            if (to != before || frame(i).is_sound == frame(j).is_sound) continue;
            const std::uint32_t without = frame(i).is_sound ? j : i, with = frame(i).is_sound ? i : j;
            if (root(without) == without) parent_[without] = root(with);
        }
        std::uint32_t sound = 0;
        while (sound < corners.size() && !frame(sound).is_sound) ++sound;
        for (std::uint32_t i = 0; i < corners.size() && sound < corners.size(); ++i)
            if (!frame(i).is_sound && root(i) == i) parent_[i] = root(sound);
        members_.clear();
        for (std::uint32_t i = 0; i < corners.size(); ++i) members_.emplace_back(root(i), corners[i]);
        std::ranges::sort(members_);
        for (auto group = members_.begin(); group != members_.end();) {
            const auto end = std::ranges::find_if(
                group, members_.end(), [&](const Member& member) { return member.first != group->first; });
            give_frame({group, end});
            group = end;
        }
    }
    std::uint32_t root(std::uint32_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }

    /// A corner, behind the root of its group.
    using Member = std::pair<std::uint32_t, std::uint32_t>;

    void give_frame(std::span<const Member> group) {
        const Vec3 n = normal_[indices_[group.front().second]];
        Vec3 along_u{}, along_v{};
        float size_u = 0, size_v = 0, sum = 0;
        for (const auto& [root, corner] : group) {
            const Frame& frame = frames_[corner / 3];
            if (!frame.is_sound) continue;
            const Vec3 p = at_corner(corner);
            const float cosine =
                dot(in_plane(at_corner(next(corner)) - p, n), in_plane(at_corner(previous(corner)) - p, n));
            const float angle = std::acos(std::clamp(cosine, -1.0f, 1.0f));
            along_u = along_u + angle * in_plane(frame.dpdu, n);
            along_v = along_v + angle * in_plane(frame.dpdv, n);
            size_u += angle * length(frame.dpdu);
            size_v += angle * length(frame.dpdv);
            sum += angle;
        }
        const float share = sum > 0 ? 1 / sum : 0;
        ++group_;
        for (const auto& [root, corner] : group)
            set(corner, share * size_u * unit(along_u), share * size_v * unit(along_v));
    }

    /// Turns derivatives to the file's own tangent, if it has one.
    void turn(std::uint32_t vertex, Vec3& dpdu, Vec3& dpdv) const {
        if (surface_.tangent.empty()) return;
        const Vec3 n = normal_[vertex], t = surface_.tangent.span()[source(vertex)];
        const Vec3 b = surface_.tangent_side[source(vertex)] * unit(cross(n, t));
        if (b == Vec3{}) return;
        // A triangle without area in the texture has no lengths.
        const auto size_or_one = [](Vec3 v) { return v == Vec3{} ? 1 : length(v); };
        dpdu = size_or_one(dpdu) * t;
        dpdv = size_or_one(dpdv) * b;
    }

    /// Gives a corner's vertex these derivatives, or a copy of the vertex if it has others already.
    void set(std::size_t corner, Vec3 dpdu, Vec3 dpdv) {
        SplitVertices& to = result_.vertices;
        const std::uint32_t vertex = indices_[corner];
        auto& [group, own] = last_[vertex];
        if (group == group_) {
            to.indices[corner] = own;
            return;
        }
        const bool has_frame = group != 0;
        group = group_;
        own = vertex;
        if (has_frame) {
            if (to.source.empty()) fill_with_numbers(to.source);
            if (to.group.empty()) fill_with_numbers(to.group);
            own = static_cast<std::uint32_t>(to.source.size());
            to.source.push_back(to.source[vertex]);
            to.group.push_back(to.group[vertex]);
            result_.dpdu.push_back({});
            result_.dpdv.push_back({});
        }
        to.indices[corner] = own;
        turn(vertex, dpdu, dpdv);
        result_.dpdu.span().set(own, dpdu);
        result_.dpdv.span().set(own, dpdv);
    }
    void fill_with_numbers(mesh_io::Array<std::uint32_t>& numbers) const {
        numbers.resize(vertices_);
        std::iota(numbers.begin(), numbers.end(), 0u);
    }

    const mesh_io::Surface& surface_;
    std::size_t vertices_;
    const mesh_io::Array<std::uint32_t>& source_;   // of vertices, before any is split
    const mesh_io::Array<std::uint32_t>& indices_;  // also before
    Tangents result_;
    std::vector<Vec3> normal_;                    // per vertex
    std::vector<Frame> frames_;                   // per triangle
    mesh_io::Array<std::uint32_t> welded_;        // per vertex
    std::vector<std::uint32_t> begin_, corners_;  // of welded vertices, and of each its corners
    std::vector<std::uint32_t> parent_;           // of corners, in the forest of groups
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges_;  // to a welded vertex, of a corner
    std::vector<Member> members_;                                 // of the groups of a welded vertex
    std::uint32_t group_ = 0;                                     // the current one, counted from 1
    /// Per vertex: the last group that it was in, and the vertex, itself or a copy, that it was there.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> last_;
};

}  // namespace

Tangents tangents_of(const mesh_io::Surface& surface, const SplitVertices& split) {
    return Builder(surface, split).run();
}

}  // namespace mesh
