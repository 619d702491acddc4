#include <catch2/catch_test_macros.hpp>

#include "support/normals.h"
#include "support/plugins.h"
#include "support/samples.h"

using candela::Mesh;
using candela::ShadingModel;
using candela::Shape;
using candela::Vec3;

namespace {

/// A sphere with unevenly distributed vertices: an octahedron, each face split into 8 x 8, and the vertices
/// displaced on the sphere. Its centre is (1, 2, -1), its radius 1.5.
struct IrregularSphere {
    Polyhedron body;
    std::vector<Double3> normal;

    IrregularSphere() {
        constexpr int n = 8;
        Random random(11);
        for (const int sign : {1, -1}) {
            for (int j = -n; j <= n; ++j) {
                for (int i = -n; i <= n; ++i) push(sign, i, j, n, random);
            }
        }
        // A square with corners (+-n, 0), (0, +-n) folded over each half; squares are split along the lines i
        // + j or i - j.
        for (const int sign : {1, -1}) {
            for (int j = -n; j < n; ++j) {
                for (int i = -n; i < n; ++i) cut(sign, i, j, n);
            }
        }
    }

  private:
    static std::size_t cell(int sign, int i, int j, int n) {
        const auto width = static_cast<std::size_t>(2 * n + 1);
        const auto row = static_cast<std::size_t>(j + n), column = static_cast<std::size_t>(i + n);
        return ((sign > 0 ? 0 : width) + row) * width + column;
    }

    void push(int sign, int i, int j, int n, Random& random) {
        const int height = n - std::abs(i) - std::abs(j);
        if (height < 0) {
            number_.push_back(0);
            return;
        }
        if (height == 0 && sign < 0) {  // the equator belongs to both halves
            number_.push_back(number_[cell(1, i, j, n)]);
            return;
        }
        const Vec3 push = random.point(0.25);
        const Double3 p =
            unit(Double3{static_cast<double>(i), static_cast<double>(j), static_cast<double>(sign * height)} +
                 exact(push));
        number_.push_back(static_cast<std::uint32_t>(normal.size()));
        normal.push_back(p);
        body.position.push_back({static_cast<float>(1 + 1.5 * p.x), static_cast<float>(2 + 1.5 * p.y),
                                 static_cast<float>(-1 + 1.5 * p.z)});
    }

    void triangle(int sign, int n, int ax, int ay, int bx, int by, int cx, int cy) {
        for (const auto& [x, y] : {std::pair{ax, ay}, {bx, by}, {cx, cy}}) {
            if (std::abs(x) + std::abs(y) > n) return;
        }
        const auto at = [&](int x, int y) { return number_[cell(sign, x, y, n)]; };
        if (sign > 0) {
            body.add(at(ax, ay), at(bx, by), at(cx, cy));
        } else {
            body.add(at(ax, ay), at(cx, cy), at(bx, by));
        }
    }

    void cut(int sign, int i, int j, int n) {
        // In the quadrants where x and y have the same sign, the folds run along i + j; in the others along i
        // - j.
        if ((i >= 0) == (j >= 0)) {
            triangle(sign, n, i, j, i + 1, j, i, j + 1);
            triangle(sign, n, i + 1, j, i + 1, j + 1, i, j + 1);
        } else {
            triangle(sign, n, i, j, i + 1, j, i + 1, j + 1);
            triangle(sign, n, i, j, i + 1, j + 1, i, j + 1);
        }
    }

    std::vector<std::uint32_t> number_;
};

double error_on(const IrregularSphere& sphere, const char* shading) {
    return largest_angle(vertex_normals(*instance<ShadingModel>(shading), sphere.body), sphere.normal);
}

}  // namespace

TEST_CASE("shading/max-weighted weights a face by sin(a) / (|P| |Q|) of its edges at the vertex (Max 1999)") {
    check_weighted_normals(
        "max-weighted", [](Double3 p, Double3 q) { return length(cross(p, q)) / (dot(p, p) * dot(q, q)); });
}

TEST_CASE("shading/max-weighted is exact on an irregular sphere; no other weight is (Max 1999)") {
    const IrregularSphere sphere;
    REQUIRE(sphere.normal.size() == 258);  // Euler: F / 2 + 2
    REQUIRE(sphere.body.triangles() == 512);
    CHECK(error_on(sphere, "max-weighted") < 2e-5);
    CHECK(error_on(sphere, "angle-weighted") > 0.01);
    CHECK(error_on(sphere, "area-weighted") > 0.01);
    CHECK(error_on(sphere, "phong") > 0.01);
}

TEST_CASE(
    "shading/max-weighted: the vertices of the shape sphere have the sphere's normals, those of Phong have "
    "not") {
    const auto shape = instance<Shape>("sphere", {{"radius", 0.7}, {"segments", std::int64_t{7}}});
    const auto error = [&](const char* shading) {
        const Mesh mesh = candela::build_mesh(*shape, {}, {}, *instance<ShadingModel>(shading));
        std::vector<Vec3> normals;
        std::vector<Double3> expected;
        for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
            normals.push_back(mesh.vertices[i].normal);
            expected.push_back(unit(exact(mesh.position.span()[i])));
        }
        return largest_angle(normals, expected);
    };
    CHECK(error("max-weighted") < 2e-6);
    CHECK(error("phong") > 0.05);
}

TEST_CASE("shading/max-weighted handles triangles without area, smooth groups and authored normals") {
    check_normals_of_odd_meshes("max-weighted");
}

TEST_CASE("shading/max-weighted normalises the interpolated vertex normal at every fragment (DD10)") {
    check_interpolated_normals("max-weighted");
}
