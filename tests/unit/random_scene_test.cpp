// The generator of random scenes, which other tests rely on.
#include "support/random_scene.h"
#include "console/diagnostics_text.h"

#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "support/command.h"
#include "support/plugins.h"

using candela::Scene;
using candela::Vec3;

TEST_CASE("random scenes satisfy the spatial constraints, and one seed always yields one scene") {
    for (unsigned seed = 0; seed < 200; ++seed) {
        const RandomScene scene = random_scene(seed);
        INFO("seed " << seed);
        REQUIRE(scene.text() == random_scene(seed).text());
        const auto is_inside = [&](Vec3 p, float radius) {
            return std::abs(p.x) + radius < scene.width / 2 && std::abs(p.y) + radius < scene.height / 2 &&
                   std::abs(p.z) + radius < scene.depth / 2;
        };
        std::vector<Vec3> points = scene.light_positions;
        points.push_back(scene.observer);
        for (std::size_t i = 0; i < points.size(); ++i) {
            REQUIRE(is_inside(points[i], 0));
            for (std::size_t k = 0; k < i; ++k) REQUIRE(candela::length(points[i] - points[k]) > 0.01f);
        }
        for (std::size_t i = 0; i < scene.objects.size(); ++i) {
            const RandomScene::Bounds& a = scene.objects[i];
            REQUIRE(is_inside(a.center, a.radius));
            for (const Vec3 p : points) REQUIRE(candela::length(p - a.center) > a.radius);
            for (std::size_t k = 0; k < i; ++k) {
                const RandomScene::Bounds& b = scene.objects[k];
                REQUIRE(candela::length(a.center - b.center) > a.radius + b.radius);
            }
        }
    }
}

TEST_CASE("the meshes of random scenes lie within the generator's bounds") {
    const std::filesystem::path directory = scratch_directory();
    int meshes = 0;
    for (unsigned seed = 0; seed < 60; ++seed) {
        const RandomScene random = random_scene(seed);
        candela::Diagnostics diagnostics;
        candela::SceneRequest request;
        request.files = {write_file(directory / (std::to_string(seed) + ".toml"), random.text())};
        const std::optional<Scene> scene = candela::read_scene(request, test_registry(), diagnostics);
        REQUIRE(scene);
        REQUIRE(scene->objects.size() == random.objects.size());
        for (std::size_t i = 0; i < scene->objects.size(); ++i) {
            const candela::Object& object = scene->objects[i];
            const auto shape = test_registry().create<candela::Shape>(
                object.shape.name, object.shape.parameters, candela::ColorEncoding::none);
            const auto shading = instance<candela::ShadingModel>("flat");
            const candela::Mesh mesh = candela::build_mesh(*shape, {}, object.transform, *shading);
            const auto position = mesh.position.span();
            REQUIRE(mesh.triangle_count() > 0);
            for (const std::uint32_t corner : mesh.indices) {
                INFO("seed " << seed << ", object " << i << " (" << object.shape.name << ")");
                REQUIRE(candela::length(position[corner] - random.objects[i].center) <=
                        random.objects[i].radius + 1e-5f);
            }
            ++meshes;
        }
    }
    CHECK(meshes > 100);
}

TEST_CASE("random scenes violate no geometric constraint") {
    const std::filesystem::path directory = scratch_directory();
    for (unsigned seed = 0; seed < 200; ++seed) {
        candela::Diagnostics diagnostics;
        candela::SceneRequest request;
        request.files = {write_file(directory / (std::to_string(seed) + ".toml"), random_scene(seed).text())};
        const auto draft = candela::draft_scene(request, test_registry(), diagnostics);
        const auto compiled = draft ? candela::build(*draft, test_registry(), diagnostics) : std::nullopt;
        INFO("seed " << seed << "\n" << diagnostics_text(diagnostics, false));
        REQUIRE(compiled);
    }
}
