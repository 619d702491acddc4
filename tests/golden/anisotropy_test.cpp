// Anisotropic highlights in pictures: the tangents of shapes reach the reflection models, in world space.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <catch2/catch_test_macros.hpp>
#include <cmath>

#include "golden/image.h"
#include "support/command.h"
#include "support/scene_tables.h"

namespace {

struct Spread {
    double x, y;  // standard deviations of the highlight on the picture, metres
};

struct Brushed {
    const char* model;
    const char* material;
};

/// The highlight of a sphere turned by `rotation` degrees about the line of sight, -z, with the light behind
/// the observer.
Spread spread(const std::filesystem::path& directory, const Brushed& surface, int rotation = 0) {
    const Image image = render_floats(
        directory,
        k_observer + "projection = \"orthographic\"\nheight = 1.2\n" + image_table(160, 160) +
            "color_management = \"none\"\n" + models("phong", surface.model) +
            "[[light]]\ntype = \"directional\"\ndirection = [0, 0, -1]\n" +
            fmt::format("[[object]]\ntype = \"sphere\"\nradius = 0.5\nsegments = 128\nrotation = [0, 0, {}]\n"
                        "[object.material]\nka = 0\nkd = 0\nks = 1\n{}",
                        rotation, surface.material));
    double sum = 0, xx = 0, yy = 0;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const Double3 p = orthographic_point(image, x, y, 1.2);
            const auto i = static_cast<double>(image.at(x, y).y);
            sum += i;
            xx += i * p.x * p.x;
            yy += i * p.y * p.y;
        }
    }
    REQUIRE(sum > 0);
    return {std::sqrt(xx / sum), std::sqrt(yy / sum)};
}

}  // namespace

TEST_CASE(
    "an anisotropic highlight on a sphere is long where its roughness is large, and turns when exchanged") {
    const auto directory = scratch_directory();
    // A sphere's tangent runs along its parallels: left to right in the picture.
    constexpr std::array<std::array<Brushed, 2>, 2> k_pairs = {
        {{{{"ward", "roughness_u = 0.3\nroughness_v = 0.1\n"},
           {"ward", "roughness_u = 0.1\nroughness_v = 0.3\n"}}},
         {{{"ashikhmin-shirley", "exponent_u = 20\nexponent_v = 200\n"},
           {"ashikhmin-shirley", "exponent_u = 200\nexponent_v = 20\n"}}}}};
    for (const auto& [along, across] : k_pairs) {
        INFO(along.model);
        const Spread wide = spread(directory, along);
        const Spread high = spread(directory, across);
        CHECK(wide.x > 2 * wide.y);
        CHECK(high.y > 2 * high.x);

        // The same effect by turning the sphere itself.
        const Spread turned = spread(directory, along, 90);
        CHECK(agree(turned.y, wide.x, 0.02));
        CHECK(agree(turned.x, wide.y, 0.02));
    }
}

TEST_CASE("a highlight of equal roughnesses is as wide as it is high") {
    const Spread round = spread(scratch_directory(), {"ward", "roughness_u = 0.1\nroughness_v = 0.1\n"});
    CHECK(agree(round.x, round.y, 0.02));
}

TEST_CASE(
    "equal roughnesses need no tangents: a mesh looks the same without texture coordinates as with them") {
    const auto directory = scratch_directory();
    const std::string positions = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\n";
    const std::string normals = "vn -0.02 -0.02 1\nvn 0.02 -0.02 1\nvn 0.02 0.02 1\nvn -0.02 0.02 1\n";
    write_file(directory / "without.obj", positions + normals + "f 1//1 2//2 3//3\nf 1//1 3//3 4//4\n");
    write_file(directory / "with.obj", positions + normals +
                                           "vt 0 0\nvt 0.6 0.8\nvt 1 1\nvt 0.1 0.9\n"
                                           "f 1/1/1 2/2/2 3/3/3\nf 1/1/1 3/3/3 4/4/4\n");
    const auto of = [&](const char* shading, const char* file, const char* roughness_v) {
        return render_floats(
            directory,
            k_observer + image_table(64, 64) + models(shading, "ward") +
                fmt::format(
                    "[[light]]\ntype = \"point\"\nposition = [1, 1, 2]\n"
                    "[[object]]\ntype = \"mesh\"\nfile = \"{}\"\n"
                    "[object.material]\nka = 0\nkd = 0\nks = 1\nroughness_u = 0.3\nroughness_v = {}\n",
                    file, roughness_v));
    };
    const auto difference = [](const Image& a, const Image& b) {
        float largest = 0, brightest = 0;
        for (std::size_t i = 0; i < a.rgb.size(); ++i) {
            largest = std::max(largest, std::abs(a.rgb[i] - b.rgb[i]));
            brightest = std::max(brightest, a.rgb[i]);
        }
        REQUIRE(brightest > 0.05f);
        return largest / brightest;
    };
    for (const char* const shading : {"gouraud", "phong"}) {
        INFO(shading);
        CHECK(difference(of(shading, "without.obj", "0.3"), of(shading, "with.obj", "0.3")) < 1e-3f);
        CHECK(difference(of(shading, "without.obj", "0.1"), of(shading, "with.obj", "0.1")) > 0.05f);
    }
}
