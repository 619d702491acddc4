// A picture rendered in bands of rows is the picture rendered at once.
#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "render/darkness_diagnosis.h"
#include "render/rendered_rows.h"
#include "support/compiled.h"
#include "support/scene_tables.h"

namespace {

/// A sphere as wide as the picture, a torus and a background that differs from row to row.
std::string scene_of(int width, int height, int samples = 1) {
    return "version = 1\n[observer]\nposition = [0.3, 1.6, 4.2]\nlook_at = [0, 0, 0]\n" + k_models +
           image_table(width, height) + "samples = " + std::to_string(samples) + R"(
background = [20, 30, 40]
[[light]]
type = "point"
position = [-2, 3, 3]
intensity = 14
[[object]]
type = "sphere"
position = [-1.2, 0, 0]
[[object]]
type = "torus"
position = [0.9, -0.2, 0.6]
rotation = [30, 0, 0]
shading = "gouraud"
reflection = "lambert"
)";
}

candela::Film image_of(const candela::RenderScene& scene, candela::PixelType pixels) {
    candela::Film film(scene.image.width, scene.image.height, pixels, scene.image.color_management);
    candela::render(scene, film, {});
    return film;
}

template <class T>
bool are_equal(std::span<const T> some, std::span<const T> all, std::size_t at) {
    return some.size() <= all.size() - at && std::ranges::equal(some, all.subspan(at, some.size()));
}

}  // namespace

TEST_CASE("a film of some rows gets the whole picture's content there") {
    for (const int samples : {1, 8}) {
        const Compiled render_scene = compiled(scene_of(203, 331, samples));
        const candela::RenderScene& scene = render_scene.scene;
        const candela::Film whole = image_of(scene, candela::PixelType::real);
        // At tile borders and within tiles.
        for (const candela::RowRange rows :
             {candela::RowRange{0, 64}, {64, 192}, {13, 14}, {50, 331}, {320, 331}}) {
            for (const int tile_size : {0, 16, 128}) {
                candela::Film some(203, 331, candela::PixelType::real, scene.image.color_management, rows);
                const auto statistics = candela::render(scene, some, {.tile_size = tile_size});
                INFO(rows.first << " to " << rows.end << ", tiles of " << tile_size);
                CHECK(some.view().height == rows.end - rows.first);
                CHECK(some.height() == 331);
                CHECK(are_equal(some.view().reals, whole.view().reals,
                                3 * 203 * static_cast<std::size_t>(rows.first)));
                CHECK(statistics.pixels_shaded <= 203 * 331);
            }
        }
    }
}

TEST_CASE("rows requested in any number are those of the picture, across several bands") {
    // A band has 64 MB: 320 of these rows.
    const Compiled render_scene = compiled(scene_of(65536, 700));
    const candela::RenderScene& scene = render_scene.scene;
    const candela::Film whole = image_of(scene, candela::PixelType::byte);
    for (const int count : {1, 64, 321, 5000}) {
        candela::RenderedRows rows(scene, candela::PixelType::byte, {100, 700}, {});
        std::size_t done = 100;
        while (done < 700) {
            const candela::ImageView some = rows.next(count);
            REQUIRE(some.height == std::min<int>(count, 700 - static_cast<int>(done)));
            REQUIRE(are_equal(some.bytes, whole.view().bytes, 3 * 65536 * done));
            done += static_cast<std::size_t>(some.height);
        }
        CHECK(rows.next(1).height == 0);
        CHECK(rows.darkness_diagnosis().empty());
        CHECK(rows.statistics().pixels_shaded > 0);
    }
}
