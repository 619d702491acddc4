// Compares shadows with closed forms: areas, penumbras, occluded hemispheres, colours of glass.
#include <fmt/format.h>

#include <array>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>

#include "golden/image.h"
#include "support/command.h"
#include "support/samples.h"
#include "support/scene_tables.h"

namespace {

/// The picture's height in metres, and the observer's distance from the wall.
constexpr double k_height = 2, k_near = 0.3;

/// A white wall in the plane z = 0, seen along -z from close to it, so that what casts shadows is behind the
/// observer.
std::string wall(int width, int height) {
    return fmt::format(
               "[room]\nwidth = 2000\nheight = 2000\ndepth = 2000\n[constraints]\noverlap = \"allow\"\n"
               "[observer]\nposition = [0, 0, {}]\nlook_at = [0, 0, 0]\nprojection = \"orthographic\"\n"
               "height = {}\n{}color_management = \"none\"\n[shadows]\nenabled = true\n",
               k_near, k_height, image_table(width, height)) +
           models("phong", "lambert") +
           "[[object]]\nname = \"wall\"\ntype = \"mesh\"\nfile = \"wall.obj\"\ncolor = [255, 255, 255]\n"
           "[object.material]\nka = 1\nkd = 1\n";
}

/// A scratch folder with the wall's file and others.
std::filesystem::path folder_with(const std::string& name = "other.obj", const std::string& obj = "") {
    const auto folder = scratch_directory();
    write_file(folder / "wall.obj", "v -40 -40 0\nv 40 -40 0\nv 40 40 0\nv -40 40 0\nf 1 2 3 4\n");
    if (!obj.empty()) write_file(folder / name, obj);
    return folder;
}

Double3 at(const Image& image, int x, int y) { return orthographic_point(image, x, y, k_height); }

/// The area in shadow, where a point in the light has the intensity `lit`.
double dark_area(const Image& image, const std::function<double(Double3)>& lit) {
    double sum = 0;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x)
            sum += 1 - static_cast<double>(image.at(x, y).x) / lit(at(image, x, y));
    }
    return sum * std::pow(k_height / image.height, 2);
}

/// Compares the means of columns with those of `expected`, to a fraction of `whole`.
void compare_columns(const Image& image, double tolerance, double whole,
                     const std::function<double(Double3)>& expected) {
    for (int x = 0; x < image.width; ++x) {
        double found = 0, sum = 0;
        for (int y = 0; y < image.height; ++y) {
            found += static_cast<double>(image.at(x, y).x) / image.height;
            sum += expected(at(image, x, y)) / image.height;
        }
        INFO("column " << x << ": " << found << ", expected " << sum);
        CHECK(std::abs(found - sum) < tolerance * whole);
    }
}

// A ball of 512 segments is inscribed: its shadow is smaller by at most (2 pi / 512)^2 / 3, a twentieth of a
// thousandth.
constexpr const char* k_ball =
    "[[object]]\ntype = \"sphere\"\nsegments = 512\nradius = 0.5\nposition = [-1.2, 0, 1.4]\n";

}  // namespace

TEST_CASE("a ball's shadow in parallel light is an ellipse of the right area") {
    // At 45 degrees: the shadow's middle is where the ball's middle is projected to.
    const Image image =
        render_floats(folder_with(),
                      wall(500, 500) + k_ball + "[[light]]\ntype = \"directional\"\ndirection = [6, 0, -7]\n",
                      {"--samples", "16"});
    const double cosine = 7 / std::hypot(6, 7);
    const double expected = std::numbers::pi * 0.25 / cosine;
    CHECK(agree(dark_area(image, [&](Double3) { return cosine; }), expected, 1e-3));
}

TEST_CASE("a ball's shadow in a point light's cone is an ellipse of the right area") {
    const Double3 lamp{-3.8, 0, 5}, ball{-1.2, 0, 1.4};
    const Image image =
        render_floats(folder_with(),
                      wall(500, 500) + k_ball +
                          "[[light]]\ntype = \"point\"\nattenuation = \"none\"\nposition = [-3.8, 0, 5]\n",
                      {"--samples", "16"});
    // The section of a cone of half-angle alpha, whose axis is at phi from the plane's normal.
    const double distance = length(ball - lamp), alpha = std::asin(0.5 / distance),
                 phi = std::acos((lamp.z - ball.z) / distance);
    const double major = lamp.z / 2 * (std::tan(phi + alpha) - std::tan(phi - alpha));
    const double eccentricity = std::sin(phi) / std::cos(alpha);
    const double expected = std::numbers::pi * major * major * std::sqrt(1 - eccentricity * eccentricity);
    const double area = dark_area(image, [&](Double3 p) { return unit(lamp - p).z; });
    CHECK(agree(area, expected, 1e-3));
}

TEST_CASE("the penumbra of a rectangle behind an edge is the part of it that is seen") {
    struct Case {
        Double3 middle, u, v;
        double turn;  // of the edge, in the plane z = 1
    };
    for (const Case& each : {Case{{0, 0, 3}, {0.8, 0, 0}, {0, 0.6, 0}, 0},
                             Case{{0.3, 0.2, 2.5}, {0.5, 0.1, 0.4}, {-0.2, 0.6, 0.2}, 0},
                             Case{{-0.2, 0.1, 3}, {0.6, 0.3, 0.1}, {-0.3, 0.5, 0}, 0.6}}) {
        const double c = std::cos(each.turn), s = std::sin(each.turn);
        // Blocks light where x c + y s < 0.
        std::string obj;
        for (const auto& [across, along] : {std::pair(-30, -30), {0, -30}, {0, 30}, {-30, 30}})
            obj += fmt::format("v {} {} 1\n", across * c - along * s, across * s + along * c);
        const auto vec = [](Double3 p) { return fmt::format("[{}, {}, {}]", p.x, p.y, p.z); };
        const Image image = render_floats(
            folder_with("edge.obj", obj + "f 1 2 3 4\n"),
            wall(160, 64) + "[[object]]\ntype = \"mesh\"\nfile = \"edge.obj\"\n" +
                fmt::format("[[light]]\ntype = \"distributed\"\nattenuation = \"none\"\nposition = {}\n"
                            "edge_u = {}\nedge_v = {}\nsamples_u = 16\nsamples_v = 16\n",
                            vec(each.middle), vec(each.u), vec(each.v)));
        compare_columns(image, 0.01, 1, [&](Double3 p) {
            constexpr int k_parts = 50;
            double sum = 0;
            for (int i = 0; i < k_parts * k_parts; ++i) {
                const Double3 q = each.middle + ((i % k_parts + 0.5) / k_parts - 0.5) * each.u +
                                  ((i / k_parts + 0.5) / k_parts - 0.5) * each.v;
                const Double3 crossing = p + (1 / q.z) * (q - p);
                if (crossing.x * c + crossing.y * s > 0) sum += unit(q - p).z / (k_parts * k_parts);
            }
            return sum;
        });
    }
}

TEST_CASE("ambient light at the foot of a wall is that from the free part of the hemisphere") {
    // To 2 %, because each pixel has only 64 rays. The upright x = -2.6, 3 m high and as long as the farthest
    // that is seen.
    const Image image = render_floats(
        folder_with("upright.obj", "v -2.6 -400 0\nv -2.6 400 0\nv -2.6 400 3\nv -2.6 -400 3\nf 1 2 3 4\n"),
        wall(160, 64) + "[[object]]\ntype = \"mesh\"\nfile = \"upright.obj\"\n" +
            "[[light]]\ntype = \"ambient\"\ncolor = [255, 255, 255]\nambient_occlusion_rays = 64\n"
            "ambient_occlusion_distance = 1000\n");
    compare_columns(image, 0.02, 1, [](Double3 p) {
        const double distance = p.x + 2.6;
        return (1 + distance / std::hypot(distance, 3)) / 2;
    });
}

TEST_CASE("ambient light on an open plane is whole, and nothing is left of it under a wide ceiling") {
    const std::string light =
        "[[light]]\ntype = \"ambient\"\ncolor = [255, 255, 255]\nambient_occlusion_rays = 32\n";
    const std::string ceiling = "v -900 -900 0.8\nv 900 -900 0.8\nv 900 900 0.8\nv -900 900 0.8\nf 4 3 2 1\n";
    const std::string with = wall(60, 40) + "[[object]]\ntype = \"mesh\"\nfile = \"ceiling.obj\"\n" + light;
    const Image open =
        render_floats(folder_with(), wall(60, 40) + light + "ambient_occlusion_distance = 1000\n");
    const Image covered =
        render_floats(folder_with("ceiling.obj", ceiling), with + "ambient_occlusion_distance = 2000\n");
    const Image out_of_reach =
        render_floats(folder_with("ceiling.obj", ceiling), with + "ambient_occlusion_distance = 0.7\n");
    for (int y = 0; y < open.height; ++y) {
        for (int x = 0; x < open.width; ++x) {
            CHECK(open.at(x, y).x == 1);
            CHECK(covered.at(x, y).x == 0);
            CHECK(out_of_reach.at(x, y).x == 1);
        }
    }
}

TEST_CASE("a spot behind an obstacle lights nothing, and one before it all that it did") {
    const std::string obstacle = "[[object]]\ntype = \"cube\"\nposition = [0, 0, 1]\nscale = [9, 9, 0.5]\n";
    const auto spot = [](double z) {
        return fmt::format(
            "[[light]]\ntype = \"spot\"\nattenuation = \"none\"\nposition = [0, 0, {}]\n"
            "direction = [0, 0, -1]\ninner_angle = 30\nouter_angle = 40\n",
            z);
    };
    const Image behind = render_floats(folder_with(), wall(80, 60) + obstacle + spot(2));
    const Image before = render_floats(folder_with(), wall(80, 60) + obstacle + spot(0.7));
    const Image alone = render_floats(folder_with(), wall(80, 60) + spot(0.7));
    int lit = 0;
    for (int y = 0; y < behind.height; ++y) {
        for (int x = 0; x < behind.width; ++x) {
            CHECK(behind.at(x, y).x == 0);
            CHECK(before.at(x, y).x == alone.at(x, y).x);
            lit += alone.at(x, y).x > 0 ? 1 : 0;
        }
    }
    CHECK(lit > 500);
}

TEST_CASE("light through a pane has the pane's colour to the power of its way inside") {
    // Its front is a square of two triangles, whose diagonal must not be seen.
    const std::string pane =
        "[[object]]\ntype = \"cube\"\nposition = [0, 0, 1]\nscale = [40, 40, 0.3]\ncolor = [230, 128, 51]\n"
        "reflection = \"dielectric\"\n[object.material]\ndepth = 0.5\n";
    for (const Double3 to_light : {Double3{0, 0, 1}, unit({1, 0, 1}), unit({-1, 2, 1.5})}) {
        const Image image = render_floats(
            folder_with(), wall(80, 60) + pane +
                               fmt::format("[[light]]\ntype = \"directional\"\ndirection = [{}, {}, {}]\n",
                                           -to_light.x, -to_light.y, -to_light.z));
        const double depths = 0.3 / to_light.z / 0.5;
        const Double3 expected =
            to_light.z * Double3{std::pow(230 / 255.0, depths), std::pow(128 / 255.0, depths),
                                 std::pow(51 / 255.0, depths)};
        for (int y = 0; y < image.height; ++y) {
            for (int x = 0; x < image.width; ++x) {
                INFO(x << ", " << y << ": " << text(image.at(x, y)) << ", expected " << text(expected));
                REQUIRE(agree(image.at(x, y), expected, 1e-4));
            }
        }
    }
}

TEST_CASE("a lamp between two walls lights both, and neither what is behind it") {
    const std::string walls =
        "[[object]]\ntype = \"cube\"\nposition = [-0.6, 0, 5]\nscale = [0.1, 30, 10]\n"
        "[[object]]\ntype = \"cube\"\nposition = [0.6, 0, 5]\nscale = [0.1, 30, 10]\n";
    const Image image = render_floats(
        folder_with(), wall(80, 60) + walls +
                           "[[light]]\ntype = \"point\"\nattenuation = \"none\"\nposition = [0.1, 0, 2]\n");
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const Double3 p = at(image, x, y);
            if (std::abs(std::abs(p.x) - 0.6) < 0.06) continue;  // the walls themselves
            const double expected = std::abs(p.x) < 0.6 ? unit(Double3{0.1, 0, 2} - p).z : 0;
            INFO(x << ", " << y);
            REQUIRE(agree(static_cast<double>(image.at(x, y).x), expected, 1e-5, 1e-7));
        }
    }
}
