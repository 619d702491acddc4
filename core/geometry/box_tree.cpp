module;

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <numeric>
#include <unsupported/Eigen/BVH>
#include <utility>
#include <vector>

module candela.geometry;

namespace candela {

namespace {

using AlignedBox = Eigen::AlignedBox3d;

AlignedBox aligned(const Box& box) {
    return {Eigen::Vector3d(box.low.x, box.low.y, box.low.z),
            Eigen::Vector3d(box.high.x, box.high.y, box.high.z)};
}

bool share_space(const Box& a, const Box& b) {
    const auto along = [](float a0, float a1, float b0, float b1) { return a0 < b1 && b0 < a1; };
    return along(a.low.x, a.high.x, b.low.x, b.high.x) && along(a.low.y, a.high.y, b.low.y, b.high.y) &&
           along(a.low.z, a.high.z, b.low.z, b.high.z);
}

/// Collects the boxes that intersect a box.
template <class Test>
struct Collector {
    AlignedBox where;
    Test test;
    std::vector<std::size_t> found{};

    bool intersectVolume(const AlignedBox& volume) const { return volume.intersects(where); }
    bool intersectObject(std::uint32_t box) {
        if (test(box)) found.push_back(box);
        return false;  // continue the search
    }
};

}  // namespace

struct BoxTree::Tree {
    std::vector<Box> boxes;
    Eigen::KdBVH<double, 3, std::uint32_t> tree;
};

BoxTree::BoxTree(std::vector<Box> boxes) : tree_(std::make_unique<Tree>()) {
    tree_->boxes = std::move(boxes);
    std::vector<std::uint32_t> numbers(tree_->boxes.size());
    std::iota(numbers.begin(), numbers.end(), 0u);
    std::vector<AlignedBox> volumes;
    volumes.reserve(tree_->boxes.size());
    for (const Box& box : tree_->boxes) volumes.push_back(aligned(box));
    if (!numbers.empty()) tree_->tree.init(numbers.begin(), numbers.end(), volumes.begin(), volumes.end());
}

BoxTree::BoxTree(BoxTree&&) noexcept = default;
BoxTree& BoxTree::operator=(BoxTree&&) noexcept = default;
BoxTree::~BoxTree() = default;

namespace {

template <class Tree, class Test>
std::vector<std::size_t> collected(const Tree& tree, const Box& where, Test test) {
    Collector<Test> collector{aligned(where), test};
    Eigen::BVIntersect(tree, collector);
    std::ranges::sort(collector.found);
    return std::move(collector.found);
}

}  // namespace

std::vector<std::size_t> BoxTree::at(Vec3 point) const {
    if (tree_->boxes.empty()) return {};
    return collected(tree_->tree, {point, point},
                     [&](std::uint32_t box) { return tree_->boxes[box].contains(point); });
}

std::vector<std::size_t> BoxTree::meeting(std::size_t box) const {
    const Box& own = tree_->boxes[box];
    return collected(tree_->tree, own, [&](std::uint32_t other) {
        return other != box && share_space(own, tree_->boxes[other]);
    });
}

namespace {

struct Range {
    float low, high;
};

/// A loop that compilers vectorise. NaN is ignored.
Range range_of(const float* values, std::size_t count) {
    constexpr std::size_t k_lanes = 16;
    std::array<float, k_lanes> low{}, high{};
    low.fill(std::numeric_limits<float>::infinity());
    high.fill(-low[0]);
    std::size_t i = 0;
    for (; i + k_lanes <= count; i += k_lanes) {
        for (std::size_t k = 0; k < k_lanes; ++k) {
            low[k] = std::min(low[k], values[i + k]);
            high[k] = std::max(high[k], values[i + k]);
        }
    }
    for (; i < count; ++i) {
        low[0] = std::min(low[0], values[i]);
        high[0] = std::max(high[0], values[i]);
    }
    return {std::ranges::min(low), std::ranges::max(high)};
}

}  // namespace

Box box_around(ConstVec3Span position, std::size_t count) {
    const Range x = range_of(position.x, count), y = range_of(position.y, count),
                z = range_of(position.z, count);
    return {{x.low, y.low, z.low}, {x.high, y.high, z.high}};
}

}  // namespace candela
