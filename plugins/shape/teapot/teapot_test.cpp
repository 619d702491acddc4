#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <map>

#include "support/plugins.h"
#include "support/samples.h"

using candela::Mesh;
using candela::Shape;
using candela::Vec3;

namespace {

Mesh teapot(double size, std::int64_t segments) {
    const auto shading = instance<candela::ShadingModel>("phong");
    return candela::build_mesh(*instance<Shape>("teapot", {{"size", size}, {"segments", segments}}),
                               {.uv = true, .derivatives = true}, {}, *shading);
}

}  // namespace

TEST_CASE("shape/teapot has 32 patches of n x n cells, less a triangle where a patch ends in a point") {
    for (const std::int64_t n : {1, 2, 5, 10}) {
        // The knob's and the bottom's four patches each end in a point: n triangles fewer.
        CHECK(teapot(1, n).triangle_count() == static_cast<std::size_t>(32 * n * n * 2 - 8 * n));
    }
}

TEST_CASE("shape/teapot has Newell's proportions and the requested height") {
    const Mesh mesh = teapot(3.15, 40);
    Vec3 low{1e9f, 1e9f, 1e9f}, high{-1e9f, -1e9f, -1e9f};
    for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
        const Vec3 p = mesh.position.span()[i];
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    // The published control net: from the handle at x = -3 to the lip of the spout, 3.15 high, the body of
    // radius 2.
    CHECK(agree(high.y - low.y, 3.15, 1e-5));
    CHECK(agree(low.y, -3.15 / 2, 1e-5));
    CHECK(agree(low.x, -3.0, 0.02));
    CHECK(agree(high.x, 3.434, 0.01));
    CHECK(agree(high.z, 2.0, 0.01));
    CHECK(agree(low.z, -2.0, 0.01));
}

TEST_CASE("shape/teapot is smooth across the seams of its patches: one place, one normal") {
    const Mesh mesh = teapot(1, 8);
    std::map<std::array<float, 3>, Vec3> normal_at;
    std::size_t shared = 0;
    for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
        const Vec3 p = mesh.position.span()[i];
        const auto [known, is_new] =
            normal_at.try_emplace({p.x + 0.0f, p.y + 0.0f, p.z + 0.0f}, mesh.vertices[i].normal);
        if (is_new) continue;
        ++shared;
        CHECK(known->second == mesh.vertices[i].normal);
    }
    CHECK(shared > 300);
    // Nearly all seams are shared: the open edges are those of the lid, the rim, and the ends of handle and
    // spout.
    CHECK(mesh.open_edges == 16 * 8);
}

TEST_CASE("shape/teapot faces outwards, and its derivatives agree with its faces") {
    const Mesh mesh = teapot(1, 12);
    std::size_t outwards = 0, checked = 0;
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
        const std::uint32_t v = mesh.indices[3 * t];
        const Vec3 n = cross(mesh.dpdu.span()[v], mesh.dpdv.span()[v]);
        if (length(n) > 1e-3f) {
            ++checked;
            if (dot(exact(n), exact(mesh.face_normal.span()[t])) > 0) ++outwards;
        }
    }
    CHECK(checked > 5000);
    CHECK(static_cast<double>(outwards) > 0.999 * static_cast<double>(checked));
    // The belly's faces point away from the axis.
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
        const Vec3 p = mesh.position.span()[mesh.indices[3 * t]];
        const double from_axis = std::hypot(p.x, p.z);
        if (from_axis < 0.57 || from_axis > 0.64 || std::abs(p.z) < 0.2) continue;
        const Vec3 n = mesh.face_normal.span()[t];
        CHECK(n.x * p.x + n.z * p.z > 0);
    }
}
