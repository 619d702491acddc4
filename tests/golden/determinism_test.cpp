// The same scene yields the same picture, however the work is divided.
#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators.hpp>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "support/command.h"
#include "support/compiled.h"
#include "support/expect.h"
#include "support/plugins.h"

namespace {

/// Four objects, three lights, all shading models, an open mesh.
constexpr const char* k_scene = R"(version = 1
[observer]
position = [0.3, 1.6, 4.2]
look_at = [0, 0, 0]
[image]
width = 333
height = 217
background = [20, 30, 40]
[reflection]
model = "phong"
[[light]]
type = "point"
position = [-2, 3, 3]
intensity = 14
[[light]]
type = "spot"
position = [3, 3, 1]
direction = [-1, -1.1, -0.3]
intensity = 14
[[light]]
type = "ambient"
color = [60, 60, 80]
[[object]]
type = "sphere"
radius = 0.5
position = [-1.6, 0, 0]
shading = "flat"
[[object]]
type = "torus"
position = [0.9, -0.7, 0.6]
rotation = [30, 0, 0]
shading = "gouraud"
[[object]]
type = "teapot"
position = [0.2, 0.1, -0.8]
shading = "phong"
reflection = "blinn-phong"
[[object]]
type = "teapot"
position = [-0.5, -0.9, 0.8]
size = 0.6
segments = 3
shading = "gouraud"
reflection = "half-lambert"
)";

/// More of it: everything that meets shadows. The floor's diagonal and the slab's edges are in symmetric
/// places.
const std::string k_shadow_scene = std::string(k_scene) + R"([[light]]
type = "distributed"
position = [0, 2.4, 0]
edge_v = [0, 0, 0.7]
samples_u = 3
samples_v = 2
intensity = 5
[[light]]
type = "directional"
direction = [0, -1, 0]
intensity = 0.4
[[light]]
type = "hemisphere"
ambient_occlusion_rays = 5
ambient_occlusion_distance = 0.7
[[object]]
name = "floor"
type = "cube"
position = [0, -1.3, 0]
scale = [4, 0.1, 4]
shading = "phong"
reflection = "lambert"
[[object]]
name = "slab"
type = "cube"
position = [0, 0.9, 0]
scale = [1, 0.1, 1]
color = [200, 250, 180]
shading = "phong"
reflection = "dielectric"
)";

/// Surfaces that cover a part of it, and of one another.
const std::string k_layered_scene = k_shadow_scene + R"([[object]]
type = "sphere"
radius = 0.8
position = [-0.6, 0.1, 0.9]
shading = "phong"
reflection = "phong"
[object.material]
opacity = 0.45
[[object]]
type = "torus"
position = [-0.2, 0.2, 0.7]
rotation = [50, 20, 0]
shading = "gouraud"
reflection = "lambert"
[object.material]
opacity = 0.3
[[object]]
type = "cube"
position = [0.7, 0, 0.8]
shading = "flat"
reflection = "lambert"
[object.material]
opacity = 0.3
opacity_cutoff = 0.5
)";

class Fixture {
  public:
    explicit Fixture(int samples, const std::string& scene = k_scene, const std::string& shadows = "false")
        : scene_(compiled(scene, {{"--samples", "image.samples", std::to_string(samples)},
                                  {"--shadows", "shadows.enabled", shadows},
                                  {"--set", "constraints.overlap", "allow"}})
                     .scene) {}

    std::vector<float> picture(int threads, int tile_size) const {
        return rows({0, scene_.image.height}, threads, tile_size);
    }

    std::vector<float> rows(candela::RowRange range, int threads, int tile_size) const {
        candela::Film film(scene_.image.width, scene_.image.height, candela::PixelType::real,
                           candela::ColorEncoding::srgb, range);
        candela::render(scene_, film, {.threads = threads, .tile_size = tile_size});
        const auto pixels = film.view().reals;
        return {pixels.begin(), pixels.end()};
    }

  private:
    candela::RenderScene scene_;
};

}  // namespace

TEST_CASE("a picture does not depend on the number of threads or the size of the tiles, to the bit") {
    for (const int samples : {1, 4, 8, 16}) {
        INFO(samples << " samples");
        const Fixture fixture(samples);
        const auto expected = fixture.picture(1, 64);
        for (const int threads : {1, 2, 3, 8}) {
            for (const int tile_size : {16, 32, 64, 128}) {
                INFO(threads << " threads, tiles of " << tile_size);
                CHECK((fixture.picture(threads, tile_size) == expected));
            }
        }
    }
}

TEST_CASE("a picture with shadows depends neither on threads nor on tiles nor on what else is rendered") {
    for (const int samples : {1, 8}) {
        INFO(samples << " samples");
        const Fixture fixture(samples, k_shadow_scene, "true");
        const auto expected = fixture.picture(1, 64);
        for (const int threads : {2, 3, 7}) {
            for (const int tile_size : {16, 32, 128}) {
                INFO(threads << " threads, tiles of " << tile_size);
                CHECK((fixture.picture(threads, tile_size) == expected));
            }
        }
        std::vector<float> in_parts;
        for (const candela::RowRange rows : {candela::RowRange{0, 1}, candela::RowRange{1, 50},
                                             candela::RowRange{50, 133}, candela::RowRange{133, 217}}) {
            const auto part = fixture.rows(rows, 2, 32);
            in_parts.insert(in_parts.end(), part.begin(), part.end());
        }
        CHECK((in_parts == expected));
        CHECK((Fixture(samples, k_shadow_scene).picture(1, 64) != expected));
    }
}

TEST_CASE("surfaces behind others depend neither on threads nor on tiles nor on what else is rendered") {
    for (const int samples : {1, 4}) {
        for (const char* const shadows : {"false", "true"}) {
            INFO(samples << " samples, shadows " << shadows);
            const Fixture fixture(samples, k_layered_scene, shadows);
            const auto expected = fixture.picture(1, 64);
            for (const int tile_size : {16, 32, 128}) {
                INFO("tiles of " << tile_size);
                CHECK((fixture.picture(3, tile_size) == expected));
            }
            std::vector<float> in_parts;
            for (const candela::RowRange rows :
                 {candela::RowRange{0, 50}, candela::RowRange{50, 133}, candela::RowRange{133, 217}}) {
                const auto part = fixture.rows(rows, 2, 32);
                in_parts.insert(in_parts.end(), part.begin(), part.end());
            }
            CHECK((in_parts == expected));
        }
    }
}

TEST_CASE("what casts and receives shadows changes nothing in a scene without them") {
    std::string scene = k_shadow_scene;
    for (const std::string of : {"[[light]]\n", "[[object]]\n"}) {
        for (std::size_t at = scene.find(of); at != std::string::npos; at = scene.find(of, at + 1))
            scene.insert(at + of.size(), "casts_shadows = false\n");
    }
    CHECK((Fixture(4, scene).picture(2, 64) == Fixture(4, k_shadow_scene).picture(2, 64)));
}

TEST_CASE("a face whose rows span several batches is the same in tiles of any size") {
    const candela::RenderScene scene = compiled(R"(version = 1
shading = { model = "phong" }
reflection = { model = "phong" }
[image]
width = 1000
height = 6
[observer]
position = [0, 0, 1]
look_at = [0, 0, 0]
fov = 1
[[light]]
type = "point"
position = [0.2, 0.1, 0.9]
[[object]]
type = "cube"
scale = [9, 9, 0.1]
)")
                                           .scene;
    const auto picture = [&](int tile_size) {
        candela::Film film(1000, 6, candela::PixelType::real, candela::ColorEncoding::srgb);
        CHECK(candela::render(scene, film, {.threads = 1, .tile_size = tile_size}).pixels_shaded == 6000);
        const auto pixels = film.view().reals;
        return std::vector<float>(pixels.begin(), pixels.end());
    };
    const std::vector<float> expected = picture(64);
    for (const int tile_size : {256, 512, 1024}) {
        INFO("tiles of " << tile_size);
        CHECK((picture(tile_size) == expected));
    }
}

TEST_CASE("the command writes the same file with one thread and with eight") {
    const auto directory = scratch_directory();
    const auto scene = write_file(directory / "scene.toml", k_scene).string();
    for (const char* const extension : {"png", "exr"}) {
        const auto one = directory / ("one." + std::string(extension)),
                   eight = directory / ("eight." + std::string(extension));
        succeeded(run_candela({"render", scene, "--samples", "4", "--threads", "1", "-o", one.string()}));
        succeeded(run_candela({"render", scene, "--samples", "4", "--threads", "8", "-o", eight.string()}));
        CHECK(read_file(one).size() > 1000);
        CHECK((read_file(one) == read_file(eight)));
    }
}

TEST_CASE("every instruction set renders the same picture except for rounding") {
    const bool has_shadows = GENERATE(false, true);
    const Fixture fixture = has_shadows ? Fixture(1, k_shadow_scene, "true") : Fixture(1);
    const candela::InstructionSet before = candela::instruction_set();
    REQUIRE(candela::use_instruction_set(candela::InstructionSet::baseline));
    const auto expected = fixture.picture(2, 64);
    for (const candela::InstructionSet set : machine_instruction_sets()) {
        INFO(candela::name_of(set));
        REQUIRE(candela::use_instruction_set(set));
        const auto picture = fixture.picture(2, 64);
        // A tiny difference in a projected vertex moves an edge by a sub-pixel, which may change a pixel on
        // it.
        std::size_t different = 0;
        for (std::size_t i = 0; i < picture.size(); ++i) {
            if (std::abs(picture[i] - expected[i]) > 1e-4f * std::max(1.0f, expected[i])) ++different;
        }
        CHECK(different < picture.size() / 2000);
    }
    candela::use_instruction_set(before);
}
