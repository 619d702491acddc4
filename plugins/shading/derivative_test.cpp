#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <span>

#include "support/command.h"
#include "support/compiled.h"
#include "support/plugins.h"
#include "support/samples.h"

namespace fs = std::filesystem;

using candela::Mesh;
using candela::ShadingModel;
using candela::Shape;
using candela::Vec3;
using candela::Vec3Arrays;

namespace {

struct Derivatives {
    Vec3 face_normal, vertex_normal, dpdu, dpdv;
};

std::vector<Vec3> normals_at(const ShadingModel& model, const std::vector<Derivatives>& points) {
    Vec3Arrays face, vertex, weight, dpdu, dpdv, result;
    for (Vec3Arrays* arrays : {&face, &vertex, &weight, &dpdu, &dpdv, &result}) arrays->resize(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        face.span().set(i, points[i].face_normal);
        vertex.span().set(i, points[i].vertex_normal);
        dpdu.span().set(i, points[i].dpdu);
        dpdv.span().set(i, points[i].dpdv);
    }
    model.normals({points.size(), face.span(), vertex.span(), weight.span(), {}, dpdu.span(), dpdv.span()},
                  result.span());
    std::vector<Vec3> normals;
    for (std::size_t i = 0; i < points.size(); ++i) normals.push_back(result.span()[i]);
    return normals;
}

double angle(Double3 a, Double3 b) { return std::atan2(length(cross(a, b)), dot(a, b)); }

using SurfaceNormal = Double3 (*)(double u, double v);

Double3 sphere_normal(double u, double v) {
    const double longitude = 2 * std::numbers::pi * u, polar = std::numbers::pi * v;
    return {std::sin(polar) * std::sin(longitude), -std::cos(polar), std::sin(polar) * std::cos(longitude)};
}

Double3 torus_normal(double u, double v) {
    const double around = 2 * std::numbers::pi * u, tube = 2 * std::numbers::pi * v;
    return {std::cos(tube) * std::sin(around), std::sin(tube), std::cos(tube) * std::cos(around)};
}

/// Angles in radians between a model's normals and the surface's own, at equal steps over each triangle.
struct Deviation {
    double mean = 0;
    double at_vertices = 0;
};

Vec3 blend(const Mesh& mesh, std::size_t triangle, const Vec3Arrays& values, Vec3 weights) {
    const std::uint32_t* const corner = &mesh.indices[3 * triangle];
    return weights.x * values.span()[corner[0]] + weights.y * values.span()[corner[1]] +
           weights.z * values.span()[corner[2]];
}

double blend(const Mesh& mesh, std::size_t triangle, std::span<const float> values, Vec3 weights) {
    const std::uint32_t* const corner = &mesh.indices[3 * triangle];
    return weights.x * values[corner[0]] + weights.y * values[corner[1]] + weights.z * values[corner[2]];
}

Deviation deviation(const Shape& shape, const char* shading, SurfaceNormal exact_normal) {
    const auto model = instance<ShadingModel>(shading);
    const Mesh mesh = candela::build_mesh(shape, {.uv = true, .derivatives = true}, {}, *model);
    constexpr int k_steps = 6;
    std::vector<Derivatives> points;
    std::vector<Double3> expected;
    std::vector<bool> is_vertex;
    const Vec3Arrays vertex_normals = mesh.vertex_normals();
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
        for (int i = 0; i <= k_steps; ++i) {
            for (int j = 0; i + j <= k_steps; ++j) {
                constexpr float k_step = 1.0f / k_steps;
                const Vec3 weights = k_step * Vec3{static_cast<float>(k_steps - i - j), static_cast<float>(i),
                                                   static_cast<float>(j)};
                const double v = blend(mesh, t, mesh.v, weights);
                if (length(blend(mesh, t, mesh.dpdu, weights)) < 1e-5f) continue;  // a pole
                points.push_back({mesh.face_normal.span()[t], blend(mesh, t, vertex_normals, weights),
                                  blend(mesh, t, mesh.dpdu, weights), blend(mesh, t, mesh.dpdv, weights)});
                expected.push_back(exact_normal(blend(mesh, t, mesh.u, weights), v));
                is_vertex.push_back(i == k_steps || j == k_steps || i + j == 0);
            }
        }
    }
    const std::vector<Vec3> normals = normals_at(*model, points);
    Deviation result;
    for (std::size_t i = 0; i < normals.size(); ++i) {
        const double error = angle(exact(normals[i]), expected[i]);
        result.mean += error / static_cast<double>(normals.size());
        if (is_vertex[i]) result.at_vertices = std::max(result.at_vertices, error);
    }
    return result;
}

/// The derivative's mean error must be less than `share` of Phong's, and zero where the shape states the
/// derivatives.
void check_better_than_phong(const Shape& shape, SurfaceNormal exact_normal, double share) {
    const Deviation own = deviation(shape, "derivative", exact_normal);
    const Deviation phong = deviation(shape, "phong", exact_normal);
    INFO("mean " << own.mean << " against " << phong.mean << ", at vertices " << own.at_vertices
                 << " against " << phong.at_vertices);
    CHECK(own.at_vertices < 1e-6);
    CHECK(phong.at_vertices > 0.01);
    CHECK(own.mean < share * phong.mean);
}

std::vector<float> rendered(const fs::path& file, const char* shading) {
    candela::SceneRequest request;
    request.files = {file};
    request.shading = {shading};
    const candela::RenderScene scene = compiled(request).scene;
    candela::Film film(scene.image.width, scene.image.height, candela::PixelType::real,
                       candela::ColorEncoding::none);
    CHECK(candela::render(scene, film, {.threads = 2}).pixels_shaded > 1000);
    return {film.view().reals.begin(), film.view().reals.end()};
}

}  // namespace

TEST_CASE("shading/derivative is the normalised dp/du x dp/dv, on the side of the vertex normal") {
    const auto model = instance<ShadingModel>("derivative");
    CHECK(model->shading_rate() == candela::ShadingRate::fragment);
    CHECK(test_registry().descriptor(candela::PluginKind::shading, "derivative").shading_needs.derivatives);
    each_way([&](std::size_t size) {
        Random random(static_cast<unsigned>(size));
        std::vector<Derivatives> points;
        std::vector<Double3> expected;
        while (points.size() < size) {
            const auto any_length = [&] { return static_cast<float>(std::pow(10, random.number(-6, 6))); };
            Vec3 u = random.direction(), v = random.direction();
            const Double3 n = cross(exact(u), exact(v));
            const Vec3 vertex_normal = random.direction();
            const double side = dot(n, exact(vertex_normal));
            if (length(n) < 0.05 || std::abs(side) < 0.01) continue;
            const float scale = any_length();  // the same for both, except for a factor of up to 10
            u = scale * u;
            v = static_cast<float>(scale * random.number(0.1, 1)) * v;
            points.push_back({random.direction(), vertex_normal, u, v});
            expected.push_back(unit((side < 0 ? -1 : 1) * n));
        }
        const std::vector<Vec3> normals = normals_at(*model, points);
        for (std::size_t i = 0; i < size; ++i) REQUIRE(agree(normals[i], expected[i], 1e-5, 1e-5));
    });
}

TEST_CASE("shading/derivative uses the face's normal where the derivatives do not span a plane") {
    const Vec3 face{0, 0, 1}, vertex{0, 0.6f, 0.8f};
    const Vec3 a{1, 0, 0}, b{0.5f, 0.1f, -0.2f};
    const float huge = 1e30f, tiny = 1e-30f;
    const std::vector<Derivatives> points = {{face, vertex, {}, {}},
                                             {face, vertex, a, {}},
                                             {face, vertex, {}, b},
                                             {face, vertex, a, a},
                                             {face, vertex, b, -3.0f * b},
                                             {face, vertex, a, tiny * b},
                                             {face, vertex, tiny * a, b},
                                             {face, {}, {}, {}},
                                             {face, vertex, huge * a, huge * a},
                                             {face, vertex, huge * a, tiny * b}};
    for (const Vec3 n : normals_at(*instance<ShadingModel>("derivative"), points)) CHECK(n == face);
}

TEST_CASE(
    "shading/derivative is closer to the true normals of a coarse sphere and torus than Phong's, and exact "
    "at vertices") {
    for (const std::int64_t segments : {12, 16, 24}) {
        INFO(segments << " segments");
        check_better_than_phong(*instance<Shape>("sphere", {{"segments", segments}}), sphere_normal, 0.6);
        check_better_than_phong(*instance<Shape>("torus", {{"segments", segments}}), torus_normal, 0.3);
    }
}

TEST_CASE("shading/derivative gives cubes and meshes from files the colours of their faces") {
    const fs::path directory = scratch_directory();
    write_file(directory / "tetrahedron.obj",
               "v 0.5 0.5 0.5\nv -0.5 -0.5 0.5\nv -0.5 0.5 -0.5\nv 0.5 -0.5 -0.5\n"
               "f 1 2 4\nf 1 3 2\nf 1 4 3\nf 2 3 4\n");
    // A distant light and a matt surface: the colour depends on the normal alone.
    const fs::path file = write_file(directory / "scene.toml", R"(version = 1
[observer]
position = [0.5, 1.2, 3]
look_at = [0, 0, 0]
[image]
width = 96
height = 96
[reflection]
model = "lambert"
[[light]]
type = "directional"
direction = [-1, -2, -3]
[[object]]
type = "cube"
position = [-0.7, 0, 0]
rotation = [20, 30, 40]
[[object]]
type = "mesh"
file = "tetrahedron.obj"
position = [0.8, 0, 0]
rotation = [10, -30, 0]
)");
    const std::vector<float> own = rendered(file, "derivative"), flat = rendered(file, "flat");
    REQUIRE(own.size() == flat.size());
    for (std::size_t i = 0; i < own.size(); ++i) REQUIRE(agree(own[i], flat[i], 1e-5, 1e-6));
}
