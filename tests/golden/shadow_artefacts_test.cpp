// Shadows have no artefacts: nothing but what is in the way blocks light, and light does not leak, at any
// scale and place.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "support/command.h"
#include "support/compiled.h"
#include "support/samples.h"
#include "support/scene_tables.h"

namespace {

using candela::Vec3;

std::vector<float> picture(const candela::RenderScene& scene) {
    candela::Film film(scene.image.width, scene.image.height, candela::PixelType::real,
                       scene.image.color_management);
    candela::render(scene, film, {.threads = 1});
    const auto pixels = film.view().reals;
    return {pixels.begin(), pixels.end()};
}

std::string vec(Vec3 v) { return fmt::format("[{:.9g}, {:.9g}, {:.9g}]", v.x, v.y, v.z); }

/// Scenes with files of meshes, rendered with shadows and without.
class Studio {
  public:
    void add_file(const std::string& name, const std::string& text) { write_file(folder_ / name, text); }

    /// The red channels of the same scene's pictures.
    struct Pair {
        std::vector<float> shadowed, lit;

        /// The number of pixels that are lit without shadows.
        int bright() const {
            return static_cast<int>(std::ranges::count_if(lit, [](float each) { return each > 0; }));
        }
        /// The number of pixels that are darker with shadows.
        int darkened() const {
            int count = 0;
            for (std::size_t i = 0; i < lit.size(); ++i) count += shadowed[i] < lit[i] * (1 - 1e-5f) ? 1 : 0;
            return count;
        }
        /// The number of pixels that are lit, and those at their left and right are in shadow, or the
        /// reverse.
        int islands() const {
            const auto is_dark = [&](std::size_t i) { return shadowed[i] < 0.5f * lit[i]; };
            int count = 0;
            for (std::size_t i = 1; i + 1 < lit.size(); ++i) {
                const bool are_all_lit = lit[i - 1] > 0 && lit[i] > 0 && lit[i + 1] > 0;
                count += are_all_lit && is_dark(i) != is_dark(i - 1) && is_dark(i) != is_dark(i + 1) ? 1 : 0;
            }
            return count;
        }
        /// The number of pixels that are lit with shadows.
        int left() const {
            return static_cast<int>(std::ranges::count_if(shadowed, [](float each) { return each > 0; }));
        }
    };
    Pair render(const std::string& text) {
        candela::SceneRequest request;
        request.files = {write_file(folder_ / "scene.toml", "version = 1\n" + text)};
        Compiled made = compiled(request);
        REQUIRE(made.scene.occlusion.has_value());
        Pair pair;
        const auto red_of = [](const std::vector<float>& pixels) {
            std::vector<float> red;
            for (std::size_t i = 0; i < pixels.size(); i += 3) red.push_back(pixels[i]);
            return red;
        };
        pair.shadowed = red_of(picture(made.scene));
        made.scene.occlusion.reset();
        pair.lit = red_of(picture(made.scene));
        return pair;
    }

  private:
    std::filesystem::path folder_ = scratch_directory();
};

/// A square from -1 to 1 in x and y, divided into n by n squares.
std::string grid_obj(int n) {
    std::string obj;
    for (int j = 0; j <= n; ++j) {
        for (int i = 0; i <= n; ++i) obj += fmt::format("v {} {} 0\n", 2.0 * i / n - 1, 2.0 * j / n - 1);
    }
    for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
            const int a = j * (n + 1) + i + 1;
            obj += fmt::format("f {} {} {} {}\n", a, a + 1, a + n + 2, a + n + 1);
        }
    }
    return obj;
}

/// A part of a cylinder around the y axis with radius 1 and smooth normals, bulging towards +z.
std::string arch_obj(int segments, double angle, bool is_hollow) {
    std::string obj;
    for (int i = 0; i <= segments; ++i) {
        const double a = angle * (static_cast<double>(i) / segments - 0.5);
        const double x = std::sin(a), z = std::cos(a), sign = is_hollow ? -1 : 1;
        obj += fmt::format("v {} -1 {}\nv {} 1 {}\nvn {} 0 {}\nvn {} 0 {}\n", x, z, x, z, sign * x, sign * z,
                           sign * x, sign * z);
    }
    for (int i = 0; i < segments; ++i) {
        const int a = 2 * i + 1;
        obj += is_hollow ? fmt::format("f {0}//{0} {1}//{1} {2}//{2} {3}//{3}\n", a, a + 1, a + 3, a + 2)
                         : fmt::format("f {0}//{0} {1}//{1} {2}//{2} {3}//{3}\n", a, a + 2, a + 3, a + 1);
    }
    return obj;
}

constexpr const char* k_shadows = "[shadows]\nenabled = true\n[constraints]\noverlap = \"allow\"\n";
constexpr const char* k_rates[] = {"flat", "gouraud", "phong"};

std::string view(Vec3 eye, Vec3 at, double room, int width = 120, int height = 100, double fov = 40) {
    return fmt::format(
        "{0}[room]\nwidth = {1}\nheight = {1}\ndepth = {1}\n"
        "[observer]\nposition = {2}\nlook_at = {3}\nup = [0.1, 0.9, 0.2]\nfov = {4}\n{5}",
        k_shadows, room, vec(eye), vec(at), fov, image_table(width, height));
}

std::string directional(Vec3 to_light) {
    return fmt::format("[[light]]\ntype = \"directional\"\ndirection = {}\n", vec(-to_light));
}
std::string point(Vec3 position) {
    return fmt::format("[[light]]\ntype = \"point\"\nattenuation = \"none\"\nposition = {}\n", vec(position));
}

}  // namespace

TEST_CASE("convex objects and planes do not shadow themselves, at any scale, place and orientation") {
    Studio studio;
    studio.add_file("quad.obj", grid_obj(1));
    studio.add_file("grid.obj", grid_obj(60));
    Random random(5);
    long long bright = 0;
    for (const char* const shape :
         {"type = \"sphere\"\nsegments = 8", "type = \"sphere\"\nsegments = 100", "type = \"cube\"",
          "type = \"mesh\"\nfile = \"quad.obj\"", "type = \"mesh\"\nfile = \"grid.obj\""}) {
        for (const char* const shading : k_rates) {
            for (int k = 0; k < 12; ++k) {
                const double unit = std::pow(10.0, random.number(-6, 4.5));
                const Vec3 at = static_cast<float>(unit * (k % 3 == 0   ? 0
                                                           : k % 3 == 1 ? 3
                                                                        : 100)) *
                                random.direction();
                const Vec3 to_eye = random.direction();
                const Vec3 to_light = normalized(to_eye + 0.9f * random.direction());
                const std::string light =
                    k % 2 == 0 ? directional(to_light) : point(at + static_cast<float>(5 * unit) * to_light);
                const auto pair = studio.render(
                    view(at + static_cast<float>(4 * unit) * to_eye, at, 300 * unit) +
                    models(shading, k % 4 < 3 ? "lambert" : "half-lambert") + light + "[[object]]\n" + shape +
                    fmt::format("\nposition = {}\nscale = {:.9g}\nrotation = [{}, {}, {}]\n", vec(at),
                                1.2 * unit, random.number(0, 360), random.number(0, 360),
                                random.number(0, 360)));
                INFO(shape << ", " << shading << ", one unit is " << unit << " m, at " << text(at));
                CHECK(pair.darkened() == 0);
                bright += pair.bright();
            }
        }
    }
    CHECK(bright > 300'000);
}

TEST_CASE("the terminator of coarse smooth meshes that bulge is that without shadows") {
    Studio studio;
    Random random(6);
    int bright = 0;
    for (const int segments : {8, 11, 16}) {
        studio.add_file("arch.obj", arch_obj(segments, 2.5, false));
        for (const std::string& shape : {fmt::format("type = \"sphere\"\nsegments = {}\nscale = 2", segments),
                                         std::string("type = \"mesh\"\nfile = \"arch.obj\"")}) {
            for (int k = 0; k < 12; ++k) {
                Vec3 to_light = random.direction();
                to_light.z *= 0.3f;
                const auto pair =
                    studio.render(view({0.5f, 0.6f, 3.5f}, {}, 20) + models("phong", "lambert") +
                                  directional(normalized(to_light)) + "[[object]]\n" + shape + "\n");
                INFO(shape << ", light from " << text(to_light));
                CHECK(pair.darkened() == 0);
                bright += pair.bright();
            }
        }
    }
    CHECK(bright > 50'000);
}

TEST_CASE("light does not leak into a closed room from outside") {
    Studio studio;
    Random random(7);
    int bright = 0;
    for (const char* const shape : {"cube", "sphere"}) {
        for (const char* const shading : k_rates) {
            for (int k = 0; k < 16; ++k) {
                const double unit = std::pow(10.0, random.number(-6, 4.5));
                const auto u = static_cast<float>(unit);
                const Vec3 at = (k % 2 == 0 ? 0 : 5 * u) * random.direction();
                const Vec3 lamp = at + (k % 4 == 0 ? 30 * u : 1.8f * u) * random.direction();
                // Towards a corner, or anywhere.
                const auto pair = studio.render(
                    view(at + 0.1f * u * random.direction(), at + u * random.direction(), 100 * unit, 160,
                         120, 110) +
                    models(shading, "lambert") + point(lamp) +
                    fmt::format(
                        "[[object]]\ntype = \"{}\"\n{}encloses = true\nposition = {}\nscale = {:.9g}\n"
                        "rotation = [{}, {}, {}]\n",
                        shape, *shape == 's' ? "segments = 10\n" : "", vec(at), unit, 20 * k % 360,
                        k % 3 == 0 ? 0 : 31 * k % 360, 0));
                INFO(shape << ", " << shading << ", one unit is " << unit << " m, lamp at " << text(lamp));
                CHECK(pair.left() == 0);
                bright += pair.bright();
            }
        }
    }
    CHECK(bright > 300'000);
}

TEST_CASE("the edges of a room are lit also where the middles of pixels are exactly on them") {
    Studio studio;
    const std::string view =
        "observer = { position = [0.0, 0.0, 0.9], look_at = [0.0, 0.0, 0.0], fov = 80.0 }\n"
        "image = { width = 128, height = 128 }\nshading = { model = \"phong\" }\n"
        "reflection = { model = \"lambert\" }\nshadows = { enabled = true }\n"
        "constraints = { overlap = \"allow\" }\n";
    // As a cube that encloses the observer, and as a file, whose left half has other diagonals.
    studio.add_file("room.obj",
                    "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n"
                    "f 1 2 3 4\nf 2 6 7 3\nf 1 5 6 2\nf 3 7 8 4\nf 8 5 1\nf 8 1 4\n");
    for (const char* const room :
         {R"(type = "cube", size = 2.0, encloses = true)", R"(type = "mesh", file = "room.obj")"}) {
        const std::string object = fmt::format("object = [{{ {} }}]\n", room);
        const auto inside =
            studio.render(view + object + R"(light = [{ type = "point", position = [0.0, 0.3, 0.0] }])");
        CHECK(inside.bright() == 128 * 128);
        CHECK(inside.darkened() == 0);
        for (const char* const place : {"0, 0.3, -1.5", "-1.5, 0.3, 0", "0.2, 1.5, 0", "-1.2, -1.2, -1.2"}) {
            INFO(room << " " << place);
            CHECK(studio
                      .render(view + object +
                              fmt::format(R"(light = [{{ type = "point", position = [{}] }}])", place))
                      .left() == 0);
        }
    }
}

TEST_CASE("light does not leak through the walls of a hollow smooth mesh") {
    Studio studio;
    Random random(8);
    for (const int segments : {8, 11, 16}) {
        studio.add_file("arch.obj", arch_obj(segments, 3.1, true));
        for (int k = 0; k < 12; ++k) {
            // From behind the arch.
            const Vec3 to_light = normalized(Vec3{static_cast<float>(random.number(-1, 1)), 0.0f,
                                                  static_cast<float>(random.number(0.1, 1))});
            const auto pair =
                studio.render(view({0.1f, 0.2f, -2}, {}, 20) + models("phong", "lambert") +
                              directional(to_light) + "[[object]]\ntype = \"mesh\"\nfile = \"arch.obj\"\n");
            INFO(segments << " segments, light from " << text(to_light));
            CHECK(pair.left() == 0);
        }
    }
}

TEST_CASE("a box's shadow begins where the box stands, on it or sunk into it") {
    Studio studio;
    for (const double unit : {1e-4, 1.0, 3e3}) {
        for (const double sunk : {0.0, 0.01}) {
            // A floor whose top is y = 0, a box from -1/2 to 1/2 on it, light from the left at 45 degrees.
            const auto pair = studio.render(
                view(static_cast<float>(unit) * Vec3{1.2f, 1.5f, 3},
                     static_cast<float>(unit) * Vec3{0.7f, 0, 0}, 20 * unit, 200, 160) +
                models("phong", "lambert") + directional(normalized(Vec3{-1, 1, 0})) +
                fmt::format("[[object]]\ntype = \"cube\"\nposition = [0, {0}, 0]\nscale = [{1}, {2}, {1}]\n"
                            "[[object]]\ntype = \"cube\"\nposition = [0, {3}, 0]\nscale = [{2}, {2}, {2}]\n",
                            -0.5 * unit, 8 * unit, unit, (0.5 - sunk) * unit));
            // No pixel of the shadow is lit, none in the light dark, along the whole edge.
            INFO("one unit is " << unit << " m, sunk " << sunk);
            CHECK(pair.darkened() > 1900);
            CHECK(pair.islands() == 0);
        }
    }
}

TEST_CASE("a lampshade lets light out only through its openings") {
    Studio studio;
    // Open at both ends: a ring of radius 1/2 from y = 1 to 2, with the lamp in its middle.
    std::string obj;
    constexpr int k_segments = 64;
    for (int i = 0; i < k_segments; ++i) {
        const double a = 2 * std::numbers::pi * i / k_segments;
        obj += fmt::format("v {0} 1 {1}\nv {0} 2 {1}\n", 0.5 * std::cos(a), 0.5 * std::sin(a));
    }
    for (int i = 0; i < k_segments; ++i) {
        const int a = 2 * i + 1, b = 2 * ((i + 1) % k_segments) + 1;
        obj += fmt::format("f {} {} {} {}\n", a, a + 1, b + 1, b);
    }
    studio.add_file("shade.obj", obj);
    studio.add_file("floor.obj", "v -6 0 6\nv 6 0 6\nv 6 0 -6\nv -6 0 -6\nf 1 2 3 4\n");
    const auto pair = studio.render(
        fmt::format("{}[room]\nwidth = 20\nheight = 20\ndepth = 20\n[observer]\nposition = [0, 0.9, 0]\n"
                    "look_at = [0, 0, 0]\nup = [0, 0, -1]\nprojection = \"orthographic\"\nheight = 6\n{}",
                    k_shadows, image_table(120, 120)) +
        models("phong", "lambert") + point({0, 1.5f, 0}) +
        "[[object]]\ntype = \"mesh\"\nfile = \"floor.obj\"\n"
        "[[object]]\ntype = \"mesh\"\nfile = \"shade.obj\"\n");
    for (int y = 0; y < 120; ++y) {
        for (int x = 0; x < 120; ++x) {
            // The lower rim's shadow has three times its radius.
            const double radius = std::hypot((x + 0.5) / 20 - 3, (y + 0.5) / 20 - 3);
            if (std::abs(radius - 1.5) < 0.03) continue;
            const std::size_t i = static_cast<std::size_t>(y) * 120 + static_cast<std::size_t>(x);
            INFO(x << ", " << y);
            CHECK(pair.shadowed[i] == (radius < 1.5 ? pair.lit[i] : 0));
        }
    }
}

TEST_CASE("a lamp on a surface, at its corner, or in its plane lights what is opposite") {
    Studio studio;
    studio.add_file("quad.obj", grid_obj(1));
    for (const float unit : {1e-5f, 1.0f, 1e4f}) {
        for (const Vec3 lamp :
             {Vec3{0, 0, 1}, Vec3{0.3f, 0.2f, 1}, Vec3{1, 1, 1}, Vec3{-1, 0.25f, 1}, Vec3{2, 0, 1}}) {
            // Two parallel squares, the lamp on the nearer one, which is behind the observer.
            const std::string square = "[[object]]\ntype = \"mesh\"\nfile = \"quad.obj\"\n";
            const auto pair = studio.render(
                view(unit * Vec3{0, 0, 0.9f}, {}, 20 * double{unit}) + models("phong", "lambert") +
                point(unit * lamp) + square + fmt::format("scale = {:.9g}\n", unit) + square +
                fmt::format("scale = {0:.9g}\nposition = [0, 0, {0:.9g}]\n", unit));
            INFO("one unit is " << unit << " m, lamp at " << text(lamp));
            CHECK(pair.darkened() == 0);
            CHECK(pair.bright() > 10000);
        }
    }
}

TEST_CASE("a decal on a floor, and boxes side by side, do not shadow one another") {
    Studio studio;
    studio.add_file("quad.obj", grid_obj(1));
    for (const float unit : {1e-5f, 1.0f, 1e4f}) {
        const auto at = [&](const char* type, Vec3 position, Vec3 scale) {
            return fmt::format("[[object]]\n{}\nposition = {}\nscale = {}\n", type, vec(unit * position),
                               vec(unit * scale));
        };
        const std::string quad = "type = \"mesh\"\nfile = \"quad.obj\"", cube = "type = \"cube\"";
        // In the same plane, z = 0, all of them.
        const auto pair = studio.render(
            view(unit * Vec3{0, 0, 4}, {}, 20 * double{unit}) + models("phong", "lambert") +
            directional(normalized(Vec3{1, 0.3f, 0.2f})) + at(quad.c_str(), {}, {1.2f, 1.2f, 1}) +
            at(quad.c_str(), {0.2f, 0, 0}, {0.3f, 0.3f, 1}) + at(cube.c_str(), {-0.5f, 0, -0.5f}, {1, 1, 1}) +
            at(cube.c_str(), {0.5f, 0, -0.5f}, {1, 1, 1}));
        INFO("one unit is " << unit << " m");
        CHECK(pair.darkened() == 0);
        CHECK(pair.bright() > 1000);
    }
}

TEST_CASE("triangles without area and needles in a mesh file block no light") {
    Studio studio;
    studio.add_file("floor.obj", "v -6 -1 6\nv 6 -1 6\nv 6 -1 -6\nv -6 -1 -6\nf 1 2 3 4\n");
    const std::string open = grid_obj(6);
    const std::string closed =
        "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv 0 0 1\n"
        "f 4 3 2 1\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n";
    Random random(9);
    for (const std::string& sound : {open, closed}) {
        // Around and between the sound triangles: points, lines, and needles a millionth as wide as they are
        // long, all of them twice; and triangles that have one corner twice.
        std::string degenerate = sound;
        for (int i = 0; i < 200; ++i) {
            const Vec3 a = random.point(1.5), b = a + random.point(1), c = a + 0.3f * (b - a);
            const Vec3 near = c + 1e-6f * random.direction();
            degenerate +=
                fmt::format("v {:.9g} {:.9g} {:.9g}\nv {:.9g} {:.9g} {:.9g}\nv {:.9g} {:.9g} {:.9g}\n", a.x,
                            a.y, a.z, b.x, b.y, b.z, i % 2 == 0 ? c.x : near.x, i % 2 == 0 ? c.y : near.y,
                            i % 2 == 0 ? c.z : near.z);
            degenerate += "f -3 -2 -1\nf -3 -3 -3\nf -3 -2 -2\nf -3 -2 -1\n";
        }
        degenerate += "f 1 1 2\nf 2 3 2\nf 5 5 5\n";
        for (const char* const shading : k_rates) {
            const auto rendered = [&](const std::string& obj) {
                studio.add_file("mesh.obj", obj);
                return studio.render(
                    view({2.5f, 1, 4}, {0, -0.5f, 0}, 30, 160, 120) + models(shading, "lambert") +
                    point({0.7f, 4, 1.5f}) + directional(normalized(Vec3{-0.4f, 1, 0.3f})) +
                    "[[object]]\ntype = \"mesh\"\nfile = \"floor.obj\"\nshading = \"phong\"\n"
                    "[[object]]\ntype = \"mesh\"\nfile = \"mesh.obj\"\n");
            };
            const auto pair = rendered(sound), with = rendered(degenerate);
            INFO(shading << (sound == open ? ", open" : ", closed"));
            CHECK(pair.darkened() > 200);
            int seen = 0, different = 0;
            for (std::size_t i = 0; i < pair.lit.size(); ++i) {
                if (with.lit[i] != pair.lit[i]) {
                    ++seen;
                } else if (with.shadowed[i] != pair.shadowed[i]) {
                    ++different;
                }
            }
            CHECK(seen <= 1);  // a needle now and then covers the middle of a pixel
            CHECK(different == 0);
        }
    }
}
