module;

#include "candela/kernel/simd_dispatch.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

module candela.geometry;

import :shaft_culling;
import candela.api;

namespace candela {

Box enlarged(const Box& box) {
    const auto magnitude = [](Vec3 v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); };
    const float by = 0x1p-16f * std::max(magnitude(box.low), magnitude(box.high));
    return {box.low - Vec3{by, by, by}, box.high + Vec3{by, by, by}};
}

namespace {

/// At least the length of any vector in the box.
float longest(const Box& box) {
    const auto largest = [](float a, float b) { return std::max(std::abs(a), std::abs(b)); };
    return length(
        {largest(box.low.x, box.high.x), largest(box.low.y, box.high.y), largest(box.low.z, box.high.z)});
}

}  // namespace

Shaft shaft_to(const Box& start, const Box& light) {
    const Box towards{light.low - start.high, light.high - start.low};
    const float most = longest(towards);
    return {.start = start,
            .low_by = light.low - start.low,
            .high_by = light.high - start.high,
            .end = 1,
            .towards = towards,
            .most_towards = most,
            .reach = most};
}

Shaft shaft_towards(const Box& start, Vec3 direction, const Box& scene) {
    return {.start = start,
            .low_by = direction,
            .high_by = direction,
            .end = std::numeric_limits<float>::infinity(),
            .towards = {direction, direction},
            .most_towards = length(direction),
            .reach = longest({scene.low - start.high, scene.high - start.low})};
}

namespace {

using Node = TriangleClusters::Node;
constexpr std::size_t k_width = TriangleClusters::k_width;

/// As many, so that small meshes have one triangle in each.
constexpr std::size_t k_clusters = 1024;
constexpr std::size_t k_most_per_cluster = 16;

/// Embree computes normals from corners relative to a ray's origin: this is their relative error, times the
/// triangle's distance over its height.
constexpr float k_normal_error = 0x1p-20f;
constexpr float k_least_cosine = 0x1p-10f;

/// Every third bit of seven.
std::uint32_t spread(std::uint32_t bits) {
    bits = (bits | bits << 8) & 0x0000700fu;
    bits = (bits | bits << 4) & 0x000430c3u;
    return (bits | bits << 2) & 0x00049249u;
}

/// Triangles whose first corners are in the same cell of a grid, up to k_most_per_cluster together, along a
/// Morton curve.
struct Clustering {
    std::vector<std::uint32_t> triangles;
    std::vector<std::uint32_t> end;  // of each cluster, in `triangles`

    explicit Clustering(const Mesh& mesh);
};

Clustering::Clustering(const Mesh& mesh) : triangles(mesh.triangle_count()) {
    const std::size_t count = triangles.size();
    // A surface passes through about 6 * 4^bits cells; aim for ten triangles in each.
    const auto square = static_cast<unsigned>(std::bit_width(count / 60));
    const unsigned bits = std::min((square + 1) / 2, 7u);
    const auto most = static_cast<float>((1u << bits) - 1);
    const Vec3 low = mesh.bounds.low, size = mesh.bounds.size();
    const float scale = static_cast<float>(1u << bits) /
                        std::max({size.x, size.y, size.z, std::numeric_limits<float>::min()});
    const auto along = [&](float at) {
        return spread(static_cast<std::uint32_t>(std::clamp(scale * at, 0.0f, most)));
    };
    std::vector<std::uint32_t> cell(count);
    parallel_for(count, 4096, [&](std::size_t begin, std::size_t past) {
        for (std::size_t t = begin; t < past; ++t) {
            const Vec3 p = mesh.vertices[mesh.indices[3 * t]].position - low;
            cell[t] = along(p.x) | along(p.y) << 1 | along(p.z) << 2;
        }
    });
    // Counting sort: at first where each cell begins, later where it ends.
    std::vector<std::uint32_t> place(std::size_t{1} << (3 * bits));
    for (const std::uint32_t each : cell) ++place[each];
    std::exclusive_scan(place.begin(), place.end(), place.begin(), std::uint32_t{0});
    for (std::uint32_t t = 0; t < count; ++t) triangles[place[cell[t]]++] = t;
    const auto most_together =
        static_cast<std::uint32_t>(std::clamp<std::size_t>(count / k_clusters, 1, k_most_per_cluster));
    for (std::uint32_t begin = 0; const std::uint32_t past : place) {
        const std::uint32_t clusters = (past - begin + most_together - 1) / most_together;
        for (std::uint32_t i = 1; i <= clusters; ++i)
            end.push_back(begin + static_cast<std::uint32_t>(std::uint64_t{past - begin} * i / clusters));
        begin = past;
    }
}

constexpr float k_infinity = std::numeric_limits<float>::infinity();
constexpr Box k_empty{{k_infinity, k_infinity, k_infinity}, {-k_infinity, -k_infinity, -k_infinity}};

/// The bounds of some triangles.
struct Cluster {
    Box position = k_empty;
    Box normal = k_empty;
    float inverse_height = 0;

    void add(const Mesh& mesh, std::uint32_t triangle) {
        std::array<Vec3, 3> corner;
        for (std::size_t k = 0; k < 3; ++k) {
            corner[k] = mesh.vertices[mesh.indices[3 * std::size_t{triangle} + k]].position;
            position = united(position, {corner[k], corner[k]});
        }
        const Vec3 a = corner[1] - corner[0], b = corner[2] - corner[0], c = corner[2] - corner[1];
        const float edge = std::sqrt(std::max({dot(a, a), dot(b, b), dot(c, c)}));
        const Vec3 twice = cross(a, b);
        const float area = length(twice), height = area / edge;
        // The normal of a needle is not known. (Nor if the height is NaN.)
        if (!(height > 0x1p-10f * edge)) return any_normal();
        const Vec3 n = (1 / area) * twice;
        normal = united(normal, {n, n});
        inverse_height = std::max(inverse_height, 1 / height);
    }
    void any_normal() { normal = {{-1, -1, -1}, {1, 1, 1}}; }
};

void set_lane(Node& node, std::size_t lane, const Cluster& cluster) {
    const Box box = enlarged(cluster.position);
    constexpr std::array k_axes{&Vec3::x, &Vec3::y, &Vec3::z};
    for (std::size_t k = 0; k < 3; ++k) {
        float Vec3::* const axis = k_axes[k];
        node.high[k][lane] = box.high.*axis;
        node.minus_low[k][lane] = -(box.low.*axis);
        node.least_normal[k][lane] = cluster.normal.low.*axis;
        node.most_normal[k][lane] = cluster.normal.high.*axis;
    }
    node.inverse_height[lane] = cluster.inverse_height;
}

void clear(Node& node) {
    for (std::size_t k = 0; k < 3; ++k) {
        node.high[k].fill(-k_infinity);
        node.minus_low[k].fill(-k_infinity);
        node.least_normal[k].fill(0);
        node.most_normal[k].fill(0);
    }
    node.inverse_height.fill(0);
}

/// Makes a lane of `to` from all of `from`.
void set_lane(Node& to, std::size_t lane, const Node& from) {
    for (std::size_t k = 0; k < 3; ++k) {
        to.high[k][lane] = std::ranges::max(from.high[k]);
        to.minus_low[k][lane] = std::ranges::max(from.minus_low[k]);
        to.least_normal[k][lane] = std::ranges::min(from.least_normal[k]);
        to.most_normal[k][lane] = std::ranges::max(from.most_normal[k]);
    }
    to.inverse_height[lane] = std::ranges::max(from.inverse_height);
}

std::size_t nodes_for(std::size_t children) { return (children + k_width - 1) / k_width; }

/// A shaft, as nodes are compared with it: six times, by s at most (`grows`) or at least
/// (bound - at) * inverse, a bound of the moving box is within that of a node.
struct ShaftTest {
    struct Side {
        float at, inverse;
        bool grows;
    };
    std::array<Side, 6> sides;
    float end;
    std::array<float, 3> least_towards, most_towards;
    float least_cosine, cosine_per_inverse_height;

    explicit ShaftTest(const Shaft& shaft) : end(shaft.end) {
        const auto side = [](float at, float by) {
            constexpr float k_no_motion = 0x1p-100f;
            return Side{at, 1 / (std::abs(by) < k_no_motion ? k_no_motion : by), by > -k_no_motion};
        };
        const auto negative = [](Vec3 v) { return std::array{-v.x, -v.y, -v.z}; };
        const Vec3 low = shaft.start.low;
        const std::array from_low{low.x, low.y, low.z}, from_high = negative(shaft.start.high);
        const std::array low_by{shaft.low_by.x, shaft.low_by.y, shaft.low_by.z},
            high_by = negative(shaft.high_by);
        for (std::size_t k = 0; k < 3; ++k) {
            sides[k] = side(from_low[k], low_by[k]);
            sides[3 + k] = side(from_high[k], high_by[k]);
        }
        least_towards = {shaft.towards.low.x, shaft.towards.low.y, shaft.towards.low.z};
        most_towards = {shaft.towards.high.x, shaft.towards.high.y, shaft.towards.high.z};
        least_cosine = k_least_cosine * shaft.most_towards;
        cosine_per_inverse_height = k_normal_error * shaft.most_towards * shaft.reach;
    }
};

/// Whether the shaft meets any cluster that may block its light.
struct ClustersLoop {
    CANDELA_BATCH_LOOP static void run(const Node* nodes, const std::uint32_t* first, std::size_t levels,
                                       const ShaftTest* shaft, bool* found) {
        struct Place {
            std::uint32_t level, node;
        };
        // Each of up to seven levels adds at most sixteen and takes one.
        std::array<Place, 128> stack;
        std::size_t size = 0;
        stack[size++] = {static_cast<std::uint32_t>(levels - 1), 0};
        const ShaftTest test = *shaft;
        while (size > 0) {
            const Place place = stack[--size];
            std::uint32_t children = met(nodes[first[place.level] + place.node], test);
            if (children != 0 && place.level == 0) {
                *found = true;
                return;
            }
            for (; children != 0; children &= children - 1)
                stack[size++] = {place.level - 1,
                                 16 * place.node + static_cast<std::uint32_t>(__builtin_ctz(children))};
        }
        *found = false;
    }

  private:
    [[gnu::always_inline]] static void move(const ShaftTest::Side& side, float bound, float& begin,
                                            float& end) {
        const float at = (bound - side.at) * side.inverse;
        const float earlier = end < at ? end : at, later = begin > at ? begin : at;
        end = side.grows ? earlier : end;
        begin = side.grows ? begin : later;
    }
    /// The least product of a number from `a` to `b` with one from `low` to `high`.
    [[gnu::always_inline]] static float least_product(float a, float b, float low, float high) {
        const float p = a * low, q = a * high, r = b * low, s = b * high;
        const float pq = p < q ? p : q, rs = r < s ? r : s;
        return pq < rs ? pq : rs;
    }
    /// A bit for each child of a node.
    [[gnu::always_inline]] static std::uint32_t met(const Node& node, const ShaftTest& test) {
        std::uint32_t children = 0;
        CANDELA_VECTORIZE_SIXTEEN
        for (std::size_t i = 0; i < k_width; ++i) {
            float begin = 0, end = test.end;
            move(test.sides[0], node.high[0][i], begin, end);
            move(test.sides[1], node.high[1][i], begin, end);
            move(test.sides[2], node.high[2][i], begin, end);
            move(test.sides[3], node.minus_low[0][i], begin, end);
            move(test.sides[4], node.minus_low[1][i], begin, end);
            move(test.sides[5], node.minus_low[2][i], begin, end);
            const float cosine = least_product(node.least_normal[0][i], node.most_normal[0][i],
                                               test.least_towards[0], test.most_towards[0]) +
                                 least_product(node.least_normal[1][i], node.most_normal[1][i],
                                               test.least_towards[1], test.most_towards[1]) +
                                 least_product(node.least_normal[2][i], node.most_normal[2][i],
                                               test.least_towards[2], test.most_towards[2]);
            const float least = test.least_cosine + test.cosine_per_inverse_height * node.inverse_height[i];
            const bool is_met = (begin <= end) & !(cosine > least);
            children |= is_met ? 1u << i : 0u;
        }
        return children;
    }
};

}  // namespace

TriangleClusters::TriangleClusters(const Mesh& mesh, bool is_one_way) {
    const Clustering clustering(mesh);
    const std::size_t clusters = clustering.end.size();
    std::size_t total = 0;
    for (std::size_t count = nodes_for(clusters);; count = nodes_for(count)) {
        first_.push_back(static_cast<std::uint32_t>(total));
        total += count;
        if (count == 1) break;
    }
    nodes_.resize(total);
    for (Node& node : nodes_) clear(node);
    parallel_for(nodes_for(clusters), 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t c = begin * k_width; c < std::min(end * k_width, clusters); ++c) {
            Cluster cluster;
            for (std::uint32_t i = c == 0 ? 0 : clustering.end[c - 1]; i < clustering.end[c]; ++i)
                cluster.add(mesh, clustering.triangles[i]);
            if (!is_one_way) cluster.any_normal();
            set_lane(nodes_[c / k_width], c % k_width, cluster);
        }
    });
    for (std::size_t level = 1; level < first_.size(); ++level) {
        for (std::uint32_t child = first_[level - 1]; child < first_[level]; ++child) {
            const std::uint32_t i = child - first_[level - 1];
            set_lane(nodes_[first_[level] + i / k_width], i % k_width, nodes_[child]);
        }
    }
}

bool TriangleClusters::may_block(const Shaft& shaft) const {
    const ShaftTest test(shaft);
    const ShaftTest* const with = &test;
    bool found = false;
    bool* const to = &found;
    multiversion<ClustersLoop>(nodes_.data(), first_.data(), first_.size(), with, to);
    return found;
}

}  // namespace candela
