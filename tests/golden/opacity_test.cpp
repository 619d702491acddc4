// Opacity, against pictures computed by hand.
#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "golden/image.h"
#include "golden/textured_square.h"
#include "support/command.h"
#include "support/expect.h"

namespace {

using Color = std::array<double, 3>;

constexpr Color k_background{0.2, 0.4, 0.6};

/// In light from everywhere, an unlit object has its own colour.
std::string scene(const std::string& objects, const std::string& image = {}, int size = k_size) {
    return fmt::format(
        "[observer]\nposition = [0, 0, 4]\nlook_at = [0, 0, 0]\nprojection = \"orthographic\"\nheight = 2\n"
        "[image]\nwidth = {0}\nheight = {0}\ncolor_management = \"none\"\nbackground = [51, 102, 153]\n{1}"
        "[shading]\nmodel = \"phong\"\n[constraints]\noverlap = \"allow\"\n[[light]]\ntype = "
        "\"ambient\"\nintensity = 1\n{2}",
        size, image, objects);
}

struct Pane {
    Color color{};
    std::string material;
    double z = 0;
    std::string more{};
};

std::string text_of(const Pane& pane) {
    return fmt::format(
        "[[object]]\ntype = \"mesh\"\nfile = \"square.obj\"\nposition = [0, 0, {}]\nreflection = \"unlit\"\n"
        "color = [{:.0f}, {:.0f}, {:.0f}]\n{}[object.material]\n{}\n",
        pane.z, 255 * pane.color[0], 255 * pane.color[1], 255 * pane.color[2], pane.more, pane.material);
}

Color over(const Color& color, double opacity, const Color& behind) {
    Color result{};
    for (std::size_t c = 0; c < 3; ++c) result[c] = opacity * color[c] + (1 - opacity) * behind[c];
    return result;
}

/// A PNG file with four channels; `alpha`: of 255, by column and row.
void write_alpha(const std::filesystem::path& file, int size, const std::function<int(int, int)>& alpha) {
    std::vector<std::uint8_t> bytes;
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            for (const int value : {10, 20, 30, alpha(x, y)})
                bytes.push_back(static_cast<std::uint8_t>(value));
        }
    }
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = image.height = static_cast<png_uint_32>(size);
    image.format = PNG_FORMAT_RGBA;
    REQUIRE(png_image_write_to_file(&image, file.c_str(), 0, bytes.data(), 0, nullptr) != 0);
}

std::filesystem::path folder_with_square() {
    const auto folder = scratch_directory();
    write_file(folder / "square.obj", k_square);
    return folder;
}

bool is_stripe(int x) { return x % 2 == 0; }

}  // namespace

TEST_CASE("golden: panes cover what is behind them by their opacity, whatever the order of the objects") {
    const std::vector<Pane> panes = {{{0.8, 0.2, 0.4}, "opacity = 0.25", 0.9},
                                     {{0.2, 0.8, 0.6}, "opacity = 0.5", 0.3},
                                     {{0.6, 0.6, 0.2}, "opacity = 0.75", -0.2},
                                     {{0.2, 0.4, 1.0}, "opacity = 0.125", -0.8}};
    Color expected = k_background;
    for (const auto& [pane, opacity] : {std::pair{3, 0.125}, {2, 0.75}, {1, 0.5}, {0, 0.25}})
        expected = over(panes[static_cast<std::size_t>(pane)].color, opacity, expected);
    const auto folder = folder_with_square();
    for (const char* const samples : {"", "samples = 4\n"}) {
        std::vector<std::size_t> order{0, 1, 2, 3};
        do {
            std::string objects;
            for (const std::size_t i : order) objects += text_of(panes[i]);
            require_pixels(render_floats(folder, scene(objects, samples)),
                           [&](int, int) { return expected; });
        } while (std::ranges::next_permutation(order).found);
    }
    SECTION("and an opaque object hides all of those behind it") {
        const Pane wall{{0.4, 0.6, 0.4}, "", 0};
        std::string objects = text_of(wall);
        for (const Pane& pane : panes) objects += text_of(pane);
        const Color seen = over(panes[0].color, 0.25, over(panes[1].color, 0.5, wall.color));
        require_pixels(render_floats(folder, scene(objects)), [&](int, int) { return seen; });
    }
    SECTION("with every shading model") {
        for (const char* const shading : {"flat", "gouraud", "phong"}) {
            const Pane pane{{0.8, 0.2, 0.4}, "opacity = 0.25", 0, fmt::format("shading = \"{}\"\n", shading)};
            require_pixels(render_floats(folder, scene(text_of(pane))),
                           [&](int, int) { return over(pane.color, 0.25, k_background); });
        }
    }
}

TEST_CASE("golden: equally near panes cover each other in the scene's order") {
    const Pane first{{1, 0, 0}, "opacity = 0.5"}, second{{0, 1, 0}, "opacity = 0.5"};
    const auto folder = folder_with_square();
    require_pixels(render_floats(folder, scene(text_of(first) + text_of(second))),
                   [&](int, int) { return over(first.color, 0.5, over(second.color, 0.5, k_background)); });
    require_pixels(render_floats(folder, scene(text_of(second) + text_of(first))),
                   [&](int, int) { return over(second.color, 0.5, over(first.color, 0.5, k_background)); });
}

TEST_CASE("golden: panes that cross are in the right order on both sides") {
    const auto turned = [](double degrees) {
        return fmt::format("rotation = [0, {}, 0]\nscale = 2\n", degrees);
    };
    const Pane left{{1, 0.2, 0}, "opacity = 0.5", 0, turned(30)},
        right{{0, 0.2, 1}, "opacity = 0.25", 0, turned(-30)};
    // A turn about y by a positive angle moves x > 0 away from the observer.
    const auto expected = [&](int x, int) {
        return x < k_size / 2 ? over(left.color, 0.5, over(right.color, 0.25, k_background))
                              : over(right.color, 0.25, over(left.color, 0.5, k_background));
    };
    const auto folder = folder_with_square();
    require_pixels(render_floats(folder, scene(text_of(left) + text_of(right))), expected);
    require_pixels(render_floats(folder, scene(text_of(right) + text_of(left))), expected);
}

TEST_CASE("golden: something is seen through both sides of a closed object") {
    const std::string ball =
        "[[object]]\ntype = \"sphere\"\nradius = 3\nreflection = \"unlit\"\ncolor = [255, 0, 0]\n"
        "[object.material]\nopacity = 0.5\n";
    require_pixels(render_floats(folder_with_square(), scene(ball)),
                   [](int, int) { return over({1, 0, 0}, 0.5, over({1, 0, 0}, 0.5, k_background)); });
}

TEST_CASE("golden: opacity may be any channel of a texture, with numbers that are linear") {
    const auto folder = folder_with_square();
    write_file(folder / "p.ppm", picture());
    write_alpha(folder / "a.png", k_size, [](int x, int y) { return 20 * x + 9 * y; });
    const Color red_pane{1, 0, 0};
    const auto with = [&](const std::string& texture) {
        return render_floats(folder, scene(text_of({red_pane, "opacity = { texture = " + texture + " }"})));
    };
    const auto expected = [&](const auto& opacity) {
        return [&, opacity](int x, int y) { return over(red_pane, opacity(x, y), k_background); };
    };
    require_pixels(with("\"p.ppm\""), expected([](int x, int) { return red(x); }), 3e-4);
    require_pixels(with("\"p.ppm\", channel = \"g\", scale = 2"),
                   expected([](int, int y) { return 2 * green(y); }), 3e-4);
    require_pixels(with("\"a.png\", channel = \"a\""),
                   expected([](int x, int y) { return (20 * x + 9 * y) / 255.0; }), 3e-4);
    // A picture without opacity is opaque.
    require_pixels(with("\"p.ppm\", channel = \"a\", scale = 0.5"), expected([](int, int) { return 0.5; }));
    SECTION("and so may other parameters be its opacity") {
        const Pane lit{
            {1, 1, 1}, "ka = { texture = \"a.png\", channel = \"a\" }", 0, "reflection = \"lambert\"\n"};
        std::string object = text_of(lit);
        object.erase(object.find("reflection = \"unlit\"\n"), 21);
        require_pixels(
            render_floats(folder, scene(object)),
            [](int x, int y) {
                const double ka = (20 * x + 9 * y) / 255.0;
                return Color{ka, ka, ka};
            },
            3e-4);
    }
}

TEST_CASE("golden: with a cutoff, a surface is opaque from there on, and absent below") {
    const auto folder = folder_with_square();
    const Color color{1, 0.6, 0};
    const auto seen = [&](const std::string& material) {
        return render_floats(folder, scene(text_of({color, material})));
    };
    require_pixels(seen("opacity = 0.5\nopacity_cutoff = 0.5"), [&](int, int) { return color; });
    require_pixels(seen("opacity = 0.5\nopacity_cutoff = 0.5001"), [](int, int) { return k_background; });
    write_alpha(folder / "a.png", k_size, [](int x, int) { return 30 * x; });
    require_pixels(seen("opacity = { texture = \"a.png\", channel = \"a\" }\nopacity_cutoff = 0.47"),
                   [&](int x, int) { return 30 * x >= 120 ? color : k_background; });
    SECTION("as its factor says") {
        require_pixels(
            seen("opacity = { texture = \"a.png\", channel = \"a\", scale = 0.5 }\nopacity_cutoff = 0.235"),
            [&](int x, int) { return 30 * x >= 120 ? color : k_background; });
    }
}

TEST_CASE("golden: a cut-out looks like a mesh without what was cut out, at any number of samples") {
    // Edges fall anywhere within pixels, but on no sample.
    constexpr int k_pixels = 29;
    const auto placed = [](const Pane& pane) {
        std::string text = text_of(pane);
        text.replace(text.find("[0, 0, 0]"), 9, "[0.055, 0, 0]");
        return text;
    };
    const auto folder = folder_with_square();
    write_alpha(folder / "stripes.png", k_size, [](int x, int) { return is_stripe(x) ? 255 : 0; });
    std::string strips = "vn 0 0 1\n";
    int vertices = 0;
    for (int i = 0; i < k_size; i += 2) {
        // Midway between the middles of an opaque and a transparent texel.
        const double left = -1 + 2.0 * i / k_size, right = left + 2.0 / k_size;
        strips += fmt::format("v {0} -1 0\nv {1} -1 0\nv {1} 1 0\nv {0} 1 0\nf {2}//1 {3}//1 {4}//1 {5}//1\n",
                              left, right, vertices + 1, vertices + 2, vertices + 3, vertices + 4);
        vertices += 4;
    }
    write_file(folder / "strips.obj", strips);
    const Pane behind{{0.2, 0.8, 0.4}, "", -0.5, "scale = 0.7\n"};
    const Pane cut{{1, 0, 0},
                   "opacity = { texture = \"stripes.png\", channel = \"a\" }\nopacity_cutoff = 0.5",
                   0,
                   "scale = 0.87\n"};
    std::string solid = placed({cut.color, "", 0, cut.more});
    solid.replace(solid.find("square.obj"), 10, "strips.obj");
    for (const char* const samples : {"samples = 1\n", "samples = 4\n", "samples = 16\n"}) {
        const Image expected = render_floats(folder, scene(solid + text_of(behind), samples, k_pixels));
        const Image image = render_floats(folder, scene(placed(cut) + text_of(behind), samples, k_pixels));
        INFO(samples);
        int red_pixels = 0;
        require_pixels(image, [&](int x, int y) {
            const auto pixel = expected.at(x, y);
            red_pixels += pixel == candela::Vec3{1, 0, 0} ? 1 : 0;
            return Color{static_cast<double>(pixel.x), static_cast<double>(pixel.y),
                         static_cast<double>(pixel.z)};
        });
        CHECK(red_pixels > k_pixels);
    }
}

TEST_CASE("golden: emission is covered like reflected light") {
    const Pane pane{{0.4, 0.4, 0.4}, "opacity = 0.25\nemission = [255, 0, 255]\nemission_strength = 2"};
    require_pixels(render_floats(folder_with_square(), scene(text_of(pane))),
                   [](int, int) { return over({2.4, 0.4, 2.4}, 0.25, k_background); });
}

TEST_CASE("golden: an object with an opacity of 1 has the picture of one without") {
    const auto folder = folder_with_square();
    const std::string behind = text_of({{0.2, 0.8, 0.4}, "opacity = 0.5", -0.5});
    const auto rendered = [&](const char* material) {
        return render_floats(folder, scene(behind + text_of({{1, 0, 0}, material, 0, "scale = 0.6\n"}),
                                           "samples = 4\n", 23))
            .rgb;
    };
    CHECK(rendered("opacity = 1") == rendered(""));
    CHECK(rendered("opacity = 1\nopacity_cutoff = 0.5") == rendered(""));
}

TEST_CASE("golden: light passes where a surface is not, and the rest of it casts a shadow") {
    const auto folder = folder_with_square();
    write_alpha(folder / "stripes.png", k_size, [](int x, int) { return is_stripe(x) ? 255 : 0; });
    // The observer looks at the wall from behind the light's pane, along the light.
    const auto wall_behind = [&](const std::string& material) {
        return render_floats(
            folder,
            fmt::format(
                "[observer]\nposition = [0, 0, 4]\nlook_at = [0, 0, 0]\nprojection = \"orthographic\"\n"
                "height = 2\n[image]\nwidth = {0}\nheight = {0}\ncolor_management = \"none\"\n"
                "[shading]\nmodel = \"phong\"\n[reflection]\nmodel = \"lambert\"\n[shadows]\nenabled = "
                "true\n[constraints]\noverlap = \"allow\"\n[[light]]\ntype = "
                "\"directional\"\ndirection = [0, 0, -1]\n"
                "[[object]]\ntype = \"mesh\"\nfile = \"square.obj\"\nreflection = \"lambert\"\ncolor = "
                "[255, 255, 255]\n[object.material]\nka = 0\nkd = 1\n"
                "[[object]]\ntype = \"mesh\"\nfile = \"square.obj\"\nposition = [0, 0, 5]\nscale = 1\n"
                "[object.material]\n{1}\n",
                k_size, material));
    };
    require_pixels(wall_behind("opacity = 0.25"), [](int, int) { return Color{0.75, 0.75, 0.75}; });
    require_pixels(wall_behind("opacity = 0.5\nopacity_cutoff = 0.6"),
                   [](int, int) { return Color{1, 1, 1}; });
    require_pixels(wall_behind("opacity = 0.5\nopacity_cutoff = 0.4"), [](int, int) { return Color{}; });
    require_pixels(
        wall_behind("opacity = { texture = \"stripes.png\", channel = \"a\" }\nopacity_cutoff = 0.5"),
        [](int x, int) { return is_stripe(x) ? Color{} : Color{1, 1, 1}; });
    require_pixels(
        wall_behind("opacity = { texture = \"stripes.png\", channel = \"a\", scale = 0.5 }"),
        [](int x, int) { return is_stripe(x) ? Color{0.5, 0.5, 0.5} : Color{1, 1, 1}; }, 1e-4);
    SECTION("also through several objects, and both sides of one") {
        require_pixels(
            wall_behind("opacity = 0.5\n[[object]]\ntype = \"cube\"\nsize = 1\nscale = [3, 3, 0.1]\n"
                        "position = [0, 0, 4.5]\n[object.material]\nopacity = 0.5"),
            [](int, int) { return Color{0.125, 0.125, 0.125}; });
    }
}
