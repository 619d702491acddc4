#include "crease.h"
#include "candela/parallel.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <span>

using candela::Vec3;

namespace mesh {

namespace {

/// Unit normals per triangle: the file's, which are exact even for slivers, or else computed from the
/// corners; zero where neither exists.
mesh_io::Array<Vec3> normals_of(const mesh_io::Surface& surface) {
    mesh_io::Array<Vec3> normals(surface.triangles());
    candela::parallel_for(normals.size(), k_per_task, [&](std::size_t begin, std::size_t end) {
        const candela::ConstVec3Span position = surface.position.span();
        for (std::size_t t = begin; t < end; ++t) {
            if (!surface.facet_normal.empty() && surface.facet_normal.span()[t] != Vec3{}) {
                normals[t] = surface.facet_normal.span()[t];
                continue;
            }
            const Vec3 a = position[surface.indices[3 * t]];
            const Vec3 p = position[surface.indices[3 * t + 1]] - a,
                       q = position[surface.indices[3 * t + 2]] - a;
            const double px = p.x, py = p.y, pz = p.z, qx = q.x, qy = q.y, qz = q.z;
            const double x = py * qz - pz * qy, y = pz * qx - px * qz, z = px * qy - py * qx;
            const double size = std::sqrt(x * x + y * y + z * z);
            const double scale = size > 0 && std::isfinite(size) ? 1 / size : 0;
            normals[t] = scale == 0 ? Vec3{}
                                    : Vec3{static_cast<float>(scale * x), static_cast<float>(scale * y),
                                           static_cast<float>(scale * z)};
        }
    });
    return normals;
}

/// Sorts the corners of one place into smooth groups.
class Grouping {
  public:
    Grouping(const mesh_io::Surface& surface, const Corners& corners, const mesh_io::Array<Vec3>& normals,
             double crease_angle)
        : surface_(surface),
          corners_(corners),
          normals_(normals),
          // Faces that meet at exactly this angle are smooth in spite of rounding.
          least_cosine_(
              crease_angle >= std::numbers::pi ? -2.0f : static_cast<float>(std::cos(crease_angle)) - 1e-6f),
          joins_only_planes_(crease_angle == 0) {}

    /// Afterwards root() tells which corners, as positions in `here`, share a normal.
    void run(std::span<const std::uint32_t> here) {
        here_ = here;
        const std::size_t n = here.size();
        parent_.resize(n);
        if (is_all_smooth()) {
            std::ranges::fill(parent_, 0u);
            return;
        }
        std::iota(parent_.begin(), parent_.end(), 0u);
        constexpr std::size_t k_few = 32;
        if (n <= k_few) {
            for (std::size_t i = 1; i < n; ++i)
                for (std::size_t j = 0; j < i; ++j)
                    if (belong_together(i, j)) join(i, j);
        } else {
            join_equal_keys();
            join_neighbors();
        }
        attach_degenerate();
    }

    std::uint32_t root(std::size_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return static_cast<std::uint32_t>(i);
    }

  private:
    std::uint32_t vertex(std::size_t i) const { return surface_.indices[here_[i]]; }
    Vec3 normal(std::size_t i) const { return normals_[here_[i] / 3]; }
    std::uint32_t smoothing(std::size_t i) const {
        return surface_.smoothing.empty() ? mesh_io::k_by_angle : surface_.smoothing[here_[i] / 3];
    }
    bool has_own_normal(std::size_t i) const {
        return !surface_.normal.empty() && surface_.normal.span()[vertex(i)] != Vec3{};
    }

    bool is_all_smooth() const {
        if (!surface_.smoothing.empty() || !surface_.normal.empty()) return false;
        const Vec3 first = normal(0);
        for (std::size_t i = 1; i < here_.size(); ++i)
            if (!are_smooth(first, normal(i))) return false;
        return true;
    }

    bool belong_together(std::size_t i, std::size_t j) const {
        if (has_own_normal(i) || has_own_normal(j)) return vertex(i) == vertex(j);
        const std::uint32_t a = smoothing(i), b = smoothing(j);
        if (a != mesh_io::k_by_angle || b != mesh_io::k_by_angle) return a == b && a != mesh_io::k_flat;
        return are_smooth(normal(i), normal(j));
    }

    /// A cosine is too coarse to tell whether faces are in one plane.
    bool are_smooth(Vec3 a, Vec3 b) const {
        constexpr float k_rounding = 1e-6f;
        if (joins_only_planes_) return dot(a - b, a - b) <= k_rounding * k_rounding;
        return dot(a, b) >= least_cosine_;
    }

    void join(std::size_t i, std::size_t j) {
        const std::uint32_t a = root(i), b = root(j);
        parent_[std::max(a, b)] = std::min(a, b);
    }

    /// Joins, of the corners sorted by `key`, adjacent ones that have the same key and belong together.
    template <class Key>
    void join_by(std::vector<std::pair<Key, std::uint32_t>>& keyed) {
        std::ranges::sort(keyed);
        for (std::size_t k = 1; k < keyed.size(); ++k) {
            if (keyed[k].first != keyed[k - 1].first) continue;
            if (belong_together(keyed[k].second, keyed[k - 1].second))
                join(keyed[k].second, keyed[k - 1].second);
        }
    }

    void join_equal_keys() {
        std::vector<std::pair<std::uint64_t, std::uint32_t>> keyed;
        for (std::uint32_t i = 0; i < here_.size(); ++i) {
            if (has_own_normal(i)) {
                keyed.emplace_back(std::uint64_t{vertex(i)} << 32, i);
            } else if (smoothing(i) != mesh_io::k_by_angle) {
                keyed.emplace_back(smoothing(i), i);
            }
        }
        join_by(keyed);
    }

    void join_neighbors() {
        std::vector<std::pair<std::uint32_t, std::uint32_t>> keyed;
        for (std::uint32_t i = 0; i < here_.size(); ++i) {
            const std::uint32_t first = here_[i] - here_[i] % 3;
            for (std::uint32_t c = first; c < first + 3; ++c)
                if (c != here_[i]) keyed.emplace_back(corners_.place(surface_.indices[c]), i);
        }
        join_by(keyed);
    }

    /// A triangle without area has no normal and needs no vertex of its own.
    void attach_degenerate() {
        std::size_t sound = here_.size();
        for (std::size_t i = 0; i < here_.size() && sound == here_.size(); ++i)
            if (normal(i) != Vec3{} && !has_own_normal(i)) sound = i;
        if (sound == here_.size()) return;
        for (std::size_t i = 0; i < here_.size(); ++i)
            if (normal(i) == Vec3{} && !has_own_normal(i) && root(i) == i) join(i, sound);
    }

    const mesh_io::Surface& surface_;
    const Corners& corners_;
    const mesh_io::Array<Vec3>& normals_;
    float least_cosine_;
    bool joins_only_planes_;
    std::span<const std::uint32_t> here_;
    std::vector<std::uint32_t> parent_;
};

/// Numbers the vertices that a place needs: one per group and vertex of the surface in it, or one per group
/// if vertices consist only of positions.
class Numbering {
  public:
    explicit Numbering(bool merges) : merges_(merges) {}

    /// Writes for each corner the number of its vertex and of the first vertex of its group.
    std::uint32_t run(const mesh_io::Surface& surface, std::span<const std::uint32_t> here,
                      Grouping& grouping, mesh_io::Array<std::uint32_t>& number,
                      mesh_io::Array<std::uint32_t>& first) {
        keys_.clear();
        for (std::uint32_t i = 0; i < here.size(); ++i)
            keys_.push_back({grouping.root(i), merges_ ? 0 : surface.indices[here[i]], i});
        if (std::ranges::any_of(keys_, [&](const Key& k) { return !k.is_same_vertex(keys_[0]); }))
            std::ranges::sort(keys_);
        std::uint32_t count = 0;
        std::uint32_t first_of_group = 0;
        for (std::size_t k = 0; k < keys_.size(); ++k) {
            if (k == 0 || !keys_[k].is_same_vertex(keys_[k - 1])) {
                if (k == 0 || keys_[k].group != keys_[k - 1].group) first_of_group = count;
                ++count;
            }
            const std::uint32_t corner = here[keys_[k].at];
            number[corner] = count - 1;
            if (!merges_) first[corner] = first_of_group;
        }
        return count;
    }

  private:
    struct Key {
        std::uint32_t group, vertex, at;
        auto operator<=>(const Key&) const = default;
        bool is_same_vertex(const Key& other) const { return group == other.group && vertex == other.vertex; }
    };
    bool merges_;
    std::vector<Key> keys_;
};

}  // namespace

SplitVertices split_at_creases(const mesh_io::Surface& surface, const Corners& corners, double crease_angle) {
    const mesh_io::Array<Vec3> normals = normals_of(surface);
    const bool merges =
        surface.u.empty() && surface.color.empty() && surface.normal.empty() && surface.attributes.empty();
    const std::size_t places = corners.places();
    SplitVertices split;
    // Numbered within each place for now.
    split.indices.resize(surface.indices.size());
    mesh_io::Array<std::uint32_t> first_of_group(merges ? 0 : surface.indices.size());
    mesh_io::Array<std::uint32_t> begin(places + 1);
    begin[0] = 0;
    candela::parallel_for(places, k_per_task, [&](std::size_t from, std::size_t to) {
        Grouping grouping(surface, corners, normals, crease_angle);
        Numbering numbering(merges);
        for (std::size_t place = from; place < to; ++place) {
            const std::span<const std::uint32_t> here = corners.at(place);
            begin[place + 1] = 0;
            if (here.empty()) continue;
            grouping.run(here);
            begin[place + 1] = numbering.run(surface, here, grouping, split.indices, first_of_group);
        }
    });
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    split.source.resize(begin.back());
    if (!merges) split.group.resize(begin.back());
    candela::parallel_for(places, k_per_task, [&](std::size_t from, std::size_t to) {
        for (std::size_t place = from; place < to; ++place) {
            for (const std::uint32_t corner : corners.at(place)) {
                const std::uint32_t vertex = split.indices[corner] += begin[place];
                split.source[vertex] = surface.indices[corner];
                if (!merges) split.group[vertex] = begin[place] + first_of_group[corner];
            }
        }
    });
    return split;
}

}  // namespace mesh
