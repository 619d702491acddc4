#include <algorithm>
#include <array>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <optional>
#include <set>
#include <vector>

#include "support/samples.h"

using candela::Camera;
using candela::Mesh;
using candela::Projection;
using candela::Vec3;

namespace {

Mesh mesh_of(const std::vector<Vec3>& vertices, const std::vector<std::uint32_t>& indices,
             bool closed = false) {
    Mesh mesh;
    mesh.position.resize(vertices.size());
    for (std::size_t i = 0; i < vertices.size(); ++i) mesh.position.span().set(i, vertices[i]);
    mesh.indices.assign(indices.begin(), indices.end());
    mesh.closed = closed;
    return mesh;
}

/// The triangles that the samples of a picture see, row by row, sample by sample.
std::vector<std::uint32_t> visible(const std::vector<const Mesh*>& meshes, const Camera& camera,
                                   int samples = 1, int tile_size = 64) {
    const candela::ProjectedScene scene = candela::project(meshes, camera, tile_size, samples);
    std::vector<std::uint32_t> ids(static_cast<std::size_t>(camera.width * camera.height * samples),
                                   candela::k_no_triangle);
    candela::TileVisibility tile;
    for (int t = 0; t < scene.tile_count(); ++t) {
        if (!candela::rasterize(scene, t, tile)) continue;
        for (int y = 0; y < tile.height; ++y) {
            for (int x = 0; x < tile.width; ++x) {
                for (int s = 0; s < samples; ++s) {
                    const int pixel = (tile.y0 + y) * camera.width + tile.x0 + x;
                    ids[static_cast<std::size_t>(pixel * samples + s)] = tile.at(s, x, y);
                }
            }
        }
    }
    return ids;
}

/// One unit is one pixel: the picture's middle is the origin.
Camera pixel_camera(int width, int height) {
    return Camera::looking({0, 0, 10}, {0, 0, 0}, {0, 1, 0}, Projection::orthographic,
                           static_cast<float>(height), width, height);
}

struct Hit {
    double distance;  // along the view
    double margin;    // smallest barycentric coordinate
};

/// Möller, Trumbore (1997), in double.
std::optional<Hit> cast(Double3 origin, Double3 direction, const std::array<Double3, 3>& t) {
    const Double3 e1 = t[1] - t[0], e2 = t[2] - t[0];
    const Double3 p = cross(direction, e2);
    const double det = dot(e1, p);
    if (std::abs(det) < 1e-14) return std::nullopt;
    const Double3 s = origin - t[0];
    const double u = dot(s, p) / det;
    const Double3 q = cross(s, e1);
    const double v = dot(direction, q) / det;
    const double along = dot(e2, q) / det;
    if (along <= -0.01) return std::nullopt;
    return Hit{along, std::min({u, v, 1 - u - v})};
}

}  // namespace

TEST_CASE("triangles that share edges leave no gap and hit no sample twice (top-left rule)") {
    // A square cut into triangles by random points: each of its samples must see exactly one of them.
    Random random(11);
    for (int round = 0; round < 20; ++round) {
        const int cells = 9;
        std::vector<Vec3> vertices;
        for (int y = 0; y <= cells; ++y) {
            for (int x = 0; x <= cells; ++x) {
                const bool is_border = x == 0 || y == 0 || x == cells || y == cells;
                // In some rounds on quarter pixels, so that many samples lie exactly on edges and corners.
                const auto jitter = [&] {
                    const double j = is_border ? 0 : random.number(-1.2, 1.2);
                    return static_cast<float>(round % 2 == 0 ? j : std::round(j * 2) / 2);
                };
                vertices.push_back({static_cast<float>(4 * x - 18) + jitter(),
                                    static_cast<float>(4 * y - 18) + jitter(), 0});
            }
        }
        std::vector<Mesh> triangles;
        const auto at = [&](int x, int y) { return vertices[static_cast<std::size_t>(y * (cells + 1) + x)]; };
        for (int y = 0; y < cells; ++y) {
            for (int x = 0; x < cells; ++x) {
                triangles.push_back(mesh_of({at(x, y), at(x + 1, y), at(x + 1, y + 1)}, {0, 1, 2}));
                triangles.push_back(mesh_of({at(x, y), at(x + 1, y + 1), at(x, y + 1)}, {0, 1, 2}));
            }
        }
        for (const int samples : {1, 4, 16}) {
            const Camera camera = pixel_camera(36, 36);
            std::vector<int> hits(static_cast<std::size_t>(36 * 36 * samples), 0);
            for (const Mesh& triangle : triangles) {
                const auto ids = visible({&triangle}, camera, samples);
                for (std::size_t i = 0; i < ids.size(); ++i)
                    hits[i] += ids[i] == candela::k_no_triangle ? 0 : 1;
            }
            CHECK(std::all_of(hits.begin(), hits.end(), [](int n) { return n == 1; }));
        }
    }
}

TEST_CASE("each sample sees what a ray hits first, even of triangles that extend behind the eye") {
    Random random(12);
    const int width = 80, height = 60;
    std::size_t compared = 0, seen = 0;
    for (int round = 0; round < 60; ++round) {
        const bool perspective = round % 3 != 2;
        const Camera camera =
            Camera::looking({0, 0, 0}, {0, 0, -1}, {0, 1, 0},
                            perspective ? Projection::perspective : Projection::orthographic,
                            perspective ? 70.0f : 3.0f, width, height);
        std::vector<Vec3> vertices;
        std::vector<std::uint32_t> indices;
        std::vector<std::array<Double3, 3>> triangles;
        for (std::uint32_t t = 0; t < 12; ++t) {
            std::array<Double3, 3> triangle;
            for (std::size_t k = 0; k < 3; ++k) {
                // Around the eye, some of it huge.
                const Vec3 p = random.point(round % 2 == 0 ? 3 : 300);
                triangle[k] = exact(p);
                vertices.push_back(p);
                indices.push_back(3 * t + static_cast<std::uint32_t>(k));
            }
            triangles.push_back(triangle);
        }
        const Mesh mesh = mesh_of(vertices, indices);
        const auto ids = visible({&mesh}, camera);
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                const double px = (x + 0.5 - 0.5 * width) / camera.pixels_per_unit;
                const double py = (0.5 * height - y - 0.5) / camera.pixels_per_unit;
                const Double3 origin = perspective ? Double3{} : Double3{px, py, 0};
                const Double3 direction = perspective ? Double3{px, py, -1} : Double3{0, 0, -1};
                std::uint32_t nearest = candela::k_no_triangle;
                double best = 1e30, second = 1e30;
                bool is_clear = true;
                for (std::uint32_t t = 0; t < triangles.size(); ++t) {
                    const auto hit = cast(origin, direction, triangles[t]);
                    if (!hit) continue;
                    // On an edge, fixed point and double may differ.
                    if (std::abs(hit->margin) < 0.02) is_clear = false;
                    if (hit->margin < 0) continue;
                    // This close to the eye, the near plane decides.
                    if (hit->distance < 0.01) is_clear = false;
                    if (hit->distance < best) {
                        second = best;
                        best = hit->distance;
                        nearest = t;
                    } else {
                        second = std::min(second, hit->distance);
                    }
                }
                if (second - best < 1e-3 * best) is_clear = false;
                if (!is_clear) continue;
                ++compared;
                if (nearest != candela::k_no_triangle) ++seen;
                INFO("round " << round << ", pixel " << x << ", " << y);
                REQUIRE(ids[static_cast<std::size_t>(y * width + x)] == nearest);
            }
        }
    }
    CHECK(compared > 100000);
    CHECK(seen > 40000);
}

TEST_CASE("a floor that passes under the observer is drawn to the picture's lower edge") {
    const Mesh floor =
        mesh_of({{-500, -1, 500}, {500, -1, 500}, {500, -1, -500}, {-500, -1, -500}}, {0, 1, 2, 0, 2, 3});
    const Camera camera =
        Camera::looking({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, Projection::perspective, 60, 64, 64);
    const auto ids = visible({&floor}, camera);
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            INFO("pixel " << x << ", " << y);
            const bool is_floor = ids[static_cast<std::size_t>(y * 64 + x)] != candela::k_no_triangle;
            CHECK(is_floor == (y >= 32));
        }
    }
}

TEST_CASE("closed meshes are culled from behind, open ones are visible from both sides") {
    const std::vector<Vec3> vertices = {{-5, -5, 0}, {5, -5, 0}, {0, 5, 0}};
    const Camera camera = pixel_camera(16, 16);
    const auto sees = [&](const std::vector<std::uint32_t>& indices, bool closed) {
        const Mesh mesh = mesh_of(vertices, indices, closed);
        const auto ids = visible({&mesh}, camera);
        return std::any_of(ids.begin(), ids.end(),
                           [](std::uint32_t id) { return id != candela::k_no_triangle; });
    };
    CHECK(sees({0, 1, 2}, true));
    CHECK_FALSE(sees({0, 2, 1}, true));
    CHECK(sees({0, 1, 2}, false));
    CHECK(sees({0, 2, 1}, false));
}

TEST_CASE(
    "of thousands of small meshes, each pixel sees the triangle that lies there, but none from behind") {
    // Squares of two triangles, and one degenerate one, so that ranges of the scene end within a mesh.
    constexpr int k_columns = 60, k_rows = 40;
    std::vector<Mesh> meshes;
    for (int i = 0; i < k_columns * k_rows; ++i) {
        const auto left = static_cast<float>(4 * (i % k_columns) - 2 * k_columns);
        const auto top = static_cast<float>(2 * k_rows - 4 * (i / k_columns));
        const bool is_reversed = i % 3 == 1, is_closed = i % 2 == 1;
        meshes.push_back(
            mesh_of({{left, top, 0}, {left, top - 4, 0}, {left + 4, top - 4, 0}, {left + 4, top, 0}},
                    is_reversed ? std::vector<std::uint32_t>{0, 2, 1, 1, 1, 2, 0, 3, 2}
                                : std::vector<std::uint32_t>{0, 1, 2, 1, 1, 2, 0, 2, 3},
                    is_closed));
    }
    std::vector<const Mesh*> all;
    for (const Mesh& mesh : meshes) all.push_back(&mesh);
    const Camera camera = pixel_camera(4 * k_columns, 4 * k_rows);
    const auto ids = visible(all, camera);
    for (int y = 0; y < camera.height; ++y) {
        for (int x = 0; x < camera.width; ++x) {
            const int i = y / 4 * k_columns + x / 4;
            const bool is_hidden = i % 3 == 1 && i % 2 == 1;
            const auto left = static_cast<std::uint32_t>(3 * i), right = left + 2;
            const std::uint32_t seen = ids[static_cast<std::size_t>(y * camera.width + x)];
            if (is_hidden) {
                REQUIRE(seen == candela::k_no_triangle);
            } else if (x % 4 == y % 4) {  // on the diagonal
                REQUIRE((seen == left || seen == right));
            } else {
                REQUIRE(seen == (x % 4 < y % 4 ? left : right));
            }
        }
    }
}

TEST_CASE("of equally near triangles, the first is seen") {
    const Mesh first = mesh_of({{-5, -5, 0}, {5, -5, 0}, {0, 5, 0}}, {0, 1, 2});
    const Mesh second = mesh_of({{-5, -5, 0}, {5, -5, 0}, {0, 5, 0}}, {0, 1, 2});
    const auto ids = visible({&first, &second}, pixel_camera(16, 16));
    CHECK(std::set<std::uint32_t>(ids.begin(), ids.end()) ==
          std::set<std::uint32_t>{0, candela::k_no_triangle});
}

TEST_CASE("the fraction of samples that see a half-plane is the fraction of the pixel that it covers") {
    // A vertical edge at x = 0.25 of the middle pixels.
    const Mesh half =
        mesh_of({{0.25f, -50, 0}, {50, -50, 0}, {50, 50, 0}, {0.25f, 50, 0}}, {0, 1, 2, 0, 2, 3});
    for (const int samples : {4, 8, 16}) {
        const auto ids = visible({&half}, pixel_camera(8, 8), samples);
        int seen = 0;
        for (int s = 0; s < samples; ++s) {
            seen +=
                ids[static_cast<std::size_t>((4 * 8 + 4) * samples + s)] == candela::k_no_triangle ? 0 : 1;
        }
        INFO(samples << " samples");
        CHECK(std::abs(static_cast<double>(seen) / samples - 0.75) <= 0.5 / samples + 1e-9);
        for (int s = 0; s < samples; ++s) {
            CHECK(ids[static_cast<std::size_t>((4 * 8 + 5) * samples + s)] != candela::k_no_triangle);
            CHECK(ids[static_cast<std::size_t>((4 * 8 + 3) * samples + s)] == candela::k_no_triangle);
        }
    }
}

TEST_CASE("sample patterns have distinct samples whose columns and rows are all different") {
    for (const int samples : {1, 4, 8, 16}) {
        std::set<int> columns, rows;
        for (const auto [x, y] : candela::sample_pattern(samples)) {
            columns.insert(x);
            rows.insert(y);
        }
        CHECK(candela::sample_pattern(samples).size() == static_cast<std::size_t>(samples));
        CHECK(columns.size() == static_cast<std::size_t>(samples));
        CHECK(rows.size() == static_cast<std::size_t>(samples));
    }
}

TEST_CASE("numbers that overflow during projection draw nothing, and do not affect others") {
    const float huge = 1e38f;
    const Mesh mesh = mesh_of({{-huge, -huge, -huge},
                               {huge, -huge, -huge},
                               {0, huge, -huge},
                               {-1, -1, -3},
                               {1, -1, -3},
                               {0, 1, -3}},
                              {0, 1, 2, 3, 4, 5});
    const Camera camera =
        Camera::looking({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, Projection::perspective, 60, 32, 32);
    const auto ids = visible({&mesh}, camera);
    CHECK(ids[16 * 32 + 16] == 1);
}

TEST_CASE("a large picture and a small tile see the same as a small picture") {
    // Above 8192 pixels, fixed point has fewer bits: an edge may move by a sixteenth of a pixel, but no more.
    const Mesh mesh = mesh_of({{-30, -10, 0}, {30, -10, 0}, {0, 14, 0}}, {0, 1, 2});
    const candela::ProjectedScene scene =
        candela::project(std::vector<const Mesh*>{&mesh}, pixel_camera(9000, 32), 64, 1);
    CHECK(scene.subpixel_bits == 4);
    candela::TileVisibility tile;
    std::size_t seen = 0;
    for (int t = 0; t < scene.tile_count(); ++t) {
        if (!candela::rasterize(scene, t, tile)) continue;
        for (int y = 0; y < tile.height; ++y) {
            for (int x = 0; x < tile.width; ++x) seen += tile.at(0, x, y) == 0 ? 1u : 0u;
        }
    }
    CHECK(std::abs(static_cast<double>(seen) - 60 * 24 / 2.0) < 40);
}
