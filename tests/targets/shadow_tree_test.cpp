// The tree of boxes that generated programs trace rays through.
#include <algorithm>
#include <array>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "candela/target.h"
#include "candela/target/shadow_tree.h"

using namespace candela;

namespace {

/// Objects of separate triangles.
class Soup : public ExportedGeometry {
  public:
    explicit Soup(std::vector<std::vector<Vec3>> objects) : corners_(std::move(objects)) {
        objects_.resize(corners_.size());
    }

    ExportedMesh in_object_space(std::size_t object) override { return in_world_space(object); }
    ExportedMesh in_world_space(std::size_t object) override {
        for (std::vector<float>& axis : axes_) axis.clear();
        indices_.clear();
        for (const Vec3 p : corners_[object]) {
            axes_[0].push_back(p.x);
            axes_[1].push_back(p.y);
            axes_[2].push_back(p.z);
            indices_.push_back(static_cast<std::uint32_t>(indices_.size()));
        }
        return {.vertex_count = corners_[object].size(),
                .indices = indices_,
                .position = {axes_[0].data(), axes_[1].data(), axes_[2].data()},
                .is_solid = object == 0};
    }
    bool has_default_normals(std::size_t, std::size_t) override { return true; }

    ExportedScene scene() {
        ExportedScene scene;
        scene.objects = objects_;
        scene.has_shadows = true;
        scene.geometry = this;
        return scene;
    }
    ExportedObject& object(std::size_t i) { return objects_[i]; }

  private:
    std::vector<std::vector<Vec3>> corners_;
    std::vector<ExportedObject> objects_;
    std::array<std::vector<float>, 3> axes_;
    std::vector<std::uint32_t> indices_;
};

std::vector<Vec3> random_triangles(std::size_t count, float size, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> place(-1, 1);
    const auto vector = [&](float by) {
        return Vec3{by * place(random), by * place(random), by * place(random)};
    };
    std::vector<Vec3> corners;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 at = vector(1);
        for (int k = 0; k < 3; ++k) corners.push_back(at + vector(size));
    }
    return corners;
}

/// The numbers of the triangles that a ray reads that misses no box, in order. `nodes`: how many of them it
/// leaves behind.
std::vector<std::size_t> triangles_on_the_way(const target::ShadowTree& tree, std::size_t& nodes) {
    std::vector<std::size_t> all;
    const std::size_t count = tree.nodes.size() / 2;
    std::size_t node = 0;
    for (nodes = 0; nodes <= count; ++nodes) {
        const std::int32_t next = tree.nodes[2 * node], leaf = tree.nodes[2 * node + 1];
        if (leaf >= 0) {
            const std::size_t first = (static_cast<std::size_t>(leaf >> 3) - 2 * count) / 3;
            for (std::size_t i = 0; i < static_cast<std::size_t>(leaf & 7); ++i) all.push_back(first + i);
            if (next < 0) return all;
        }
        node = leaf >= 0 ? static_cast<std::size_t>(next) : node + 1;
        REQUIRE(node < count);
    }
    return all;
}

}  // namespace

TEST_CASE("shadow tree: a ray that misses no box passes each node once, and reads each triangle once") {
    for (const std::size_t count : {std::size_t{1}, std::size_t{4}, std::size_t{5}, std::size_t{3000}}) {
        Soup soup({random_triangles(count, 0.1f, 1), random_triangles(count, 0.1f, 2)});
        const target::ShadowTree tree = target::shadow_tree(soup.scene());
        std::size_t nodes = 0;
        std::vector<std::size_t> read = triangles_on_the_way(tree, nodes);
        CHECK(nodes + 1 == tree.nodes.size() / 2);
        std::ranges::sort(read);
        REQUIRE(read.size() == 2 * count);
        CHECK(tree.triangle_count == 2 * count);
        for (std::size_t i = 0; i < read.size(); ++i) CHECK(read[i] == i);
        const std::set<std::int32_t> places(tree.places.begin(), tree.places.end());
        CHECK(places.size() == 2 * count);
        CHECK(*places.begin() == 0);
    }
}

TEST_CASE("shadow tree: triangles at the same place share leaves, and objects without shadows are left out") {
    const std::vector<Vec3> one = random_triangles(1, 1, 3);
    std::vector<Vec3> many;
    for (int i = 0; i < 1000; ++i) many.insert(many.end(), one.begin(), one.end());
    Soup soup({many, random_triangles(7, 1, 4)});
    soup.object(1).casts_shadows = false;
    const target::ShadowTree tree = target::shadow_tree(soup.scene());
    std::size_t nodes = 0;
    CHECK(triangles_on_the_way(tree, nodes).size() == 1000);
    REQUIRE(tree.places.size() == 1007);
    CHECK(std::ranges::all_of(std::span(tree.places).subspan(1000), [](auto place) { return place == -1; }));

    soup.object(0).casts_shadows = false;
    const target::ShadowTree empty = target::shadow_tree(soup.scene());
    CHECK(triangles_on_the_way(empty, nodes).empty());
    CHECK(empty.triangle_count == 0);
}

TEST_CASE(
    "shadow tree: rays keep away from surfaces by a millionth of the largest triangle of an open object") {
    const std::vector<Vec3> large{{0, 0, 0}, {8, 0, 0}, {0, 0, -3}}, small{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}};
    CHECK(target::shadow_tree(Soup({small, large}).scene()).least_margin == 8 * std::exp2(-20.0f));
    CHECK(target::shadow_tree(Soup({large, small}).scene()).least_margin == 2 * std::exp2(-20.0f));
    CHECK(target::shadow_tree(Soup({large, {}}).scene()).least_margin == 0);
}
