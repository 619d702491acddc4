// candela render --terms: compares layers, read back by OpenImageIO, with known values of a square seen head
// on, and with the picture whose terms they are.
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <catch2/catch_approx.hpp>
#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators.hpp>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "support/command.h"
#include "support/expect.h"
#include "support/text.h"

namespace fs = std::filesystem;
using Catch::Approx;

namespace {

/// The channels of a layered picture, by name.
struct Layers {
    int width = 0, height = 0;
    std::map<std::string, std::vector<float>> channels;

    float at(const std::string& channel, int x, int y) const {
        const auto found = channels.find(channel);
        INFO(channel);
        REQUIRE(found != channels.end());
        return found->second[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                             static_cast<std::size_t>(x)];
    }
};

Layers read_layers(const fs::path& file) {
    const auto input = OIIO::ImageInput::open(file.string());
    REQUIRE(input != nullptr);
    const OIIO::ImageSpec& spec = input->spec();
    Layers layers{spec.width, spec.height, {}};
    const auto count = static_cast<std::size_t>(spec.nchannels);
    std::vector<float> all(count * static_cast<std::size_t>(spec.width) *
                           static_cast<std::size_t>(spec.height));
    REQUIRE(input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeFloat, all.data()));
    for (std::size_t c = 0; c < count; ++c) {
        std::vector<float>& values = layers.channels[spec.channelnames[c]];
        for (std::size_t i = c; i < all.size(); i += count) values.push_back(all[i]);
    }
    REQUIRE(layers.channels.size() == count);
    return layers;
}

Layers render_layers(const fs::path& folder, const std::string& scene, const std::string& terms) {
    const auto file = write_file(folder / "scene.toml", scene);
    const auto image = folder / "picture.exr";
    succeeded(run_candela({"render", file.string(), "-o", image.string(), "--terms", terms, "--quiet"}));
    return read_layers(image);
}

/// A cube's front face, one metre wide, half a metre in front of the origin, four metres from the observer.
/// The background is visible at the picture's edge. Light falls on the face at 60 degrees.
constexpr const char* k_square = R"(version = 1
[observer]
position = [0.0, 0.0, 4.5]
look_at = [0.0, 0.0, 0.0]
fov = 20.0
[image]
width = 60
height = 60
background = [51, 51, 51]
color_management = "none"
[shading]
model = "flat"
[reflection]
model = "phong"
[[light]]
name = "sun"
type = "directional"
direction = [0.8660254, 0.0, -0.5]
intensity = 2.0
[[light]]
name = "sky"
type = "ambient"
color = [255, 255, 255]
intensity = 0.25
[[object]]
type = "cube"
color = [255, 51, 0]
[object.material]
ka = 0.4
kd = 0.8
ks = 0.0
)";

/// Objects of each shading rate, one transparent, one open, with a light of each type and anti-aliasing.
constexpr const char* k_many = R"(version = 1
[observer]
position = [0.3, 1.6, 4.2]
look_at = [0, 0, 0]
fov = 36
[image]
width = 96
height = 64
samples = 4
background = [20, 30, 40]
[[light]]
name = "lamp"
type = "point"
position = [-2, 3, 3]
intensity = 6
[[light]]
type = "ambient"
color = [60, 60, 80]
[[light]]
type = "spot"
position = [2, 3, 3]
direction = [-0.6, -1, -1]
intensity = 8
[[light]]
type = "hemisphere"
intensity = 0.1
[[light]]
type = "distributed"
position = [0, 4, 2]
intensity = 3
[[object]]
type = "sphere"
position = [-1.1, 0, 0]
shading = "gouraud"
reflection = "blinn-phong"
[[object]]
type = "torus"
position = [0.9, -0.2, 0.6]
rotation = [30, 0, 0]
shading = "flat"
reflection = "phong"
[[object]]
type = "cube"
position = [0.2, 0.1, -1.2]
shading = "phong"
reflection = "ggx"
[[object]]
type = "sphere"
radius = 0.3
position = [0, 1.2, 0.5]
shading = "phong"
reflection = "dielectric"
)";

}  // namespace

TEST_CASE("terms of a square seen head on match values computed by hand") {
    const Layers layers = render_layers(scratch_directory(), k_square, "all");
    // The centre of pixel (29, 20), on the face: half the picture's height is tan(10 degrees) of its
    // distance.
    const double half = 4.0 * std::tan(10 * 3.14159265358979323846 / 180);
    const double x = half * (29.5 / 30 - 1), y = half * (1 - 20.5 / 30);
    const auto at = [&](const std::string& channel) { return layers.at(channel, 29, 20); };
    // I_d = I kd C_o N.L = 2 x 0.8 x C_o x 0.5, I_a = I ka C_o = 0.25 x 0.4 x C_o.
    CHECK(at("ambient.R") == Approx(0.1));
    CHECK(at("ambient.G") == Approx(0.02));
    CHECK(at("diffuse.R") == Approx(0.8));
    CHECK(at("diffuse.G") == Approx(0.16));
    CHECK(at("diffuse.B") == 0);
    CHECK(at("specular.R") == 0);
    CHECK(at("surroundings.R") == 0);
    CHECK(at("background.R") == 0);
    // Of 0.9, 0.18 and 0, with the weights of Rec. 709.
    CHECK(at("luminance") == Approx(0.2126 * 0.9 + 0.7152 * 0.18));
    CHECK(at("light.sun.R") == Approx(0.8));
    CHECK(at("light.sky.R") == Approx(0.1));
    CHECK(at("R") == Approx(0.9));
    CHECK(at("n_dot_l.sun") == Approx(0.5));
    CHECK(at("n_dot_l.sky") == 0);
    CHECK(at("N.X") == 0);
    CHECK(at("N.Y") == 0);
    CHECK(at("N.Z") == 1);
    CHECK(at("color.R") == 1);
    CHECK(at("color.G") == Approx(0.2));
    CHECK(at("Ng.Z") == 1);
    CHECK(at("Z") == Approx(4.0));
    CHECK(at("P.X") == Approx(x));
    CHECK(at("P.Y") == Approx(y));
    CHECK(at("P.Z") == Approx(0.5));
    CHECK(at("barycentric.X") + at("barycentric.Y") + at("barycentric.Z") == Approx(1));
    CHECK(at("opacity") == 1);
    CHECK(at("facing") == 1);
    CHECK(at("object") == 0);
    CHECK(at("triangle") >= 0);
    CHECK(at("triangle") < 12);
    // Its two triangles meet in a diagonal.
    CHECK(layers.at("triangle", 12, 14) != layers.at("triangle", 46, 44));

    const auto beyond = [&](const std::string& channel) { return layers.at(channel, 1, 30); };
    CHECK(beyond("R") == Approx(0.2));
    CHECK(beyond("background.R") == Approx(0.2));
    CHECK(beyond("luminance") == 0);
    CHECK(beyond("light.sun.R") == 0);
    CHECK(beyond("diffuse.R") == 0);
    CHECK(beyond("color.R") == 0);
    CHECK(std::isinf(beyond("Z")));
    CHECK(beyond("opacity") == 0);
    CHECK(beyond("facing") == 0);
    CHECK(beyond("object") == -1);
    CHECK(beyond("triangle") == -1);
}

TEST_CASE("colours and parameters of materials are terms: textures, and values where there are none") {
    const fs::path folder = scratch_directory();
    const std::string steps{0,         0,         0,         85,        85,        85,
                            char(170), char(170), char(170), char(255), char(255), char(255)};
    write_file(folder / "steps.ppm", "P6\n4 1\n255\n" + steps);
    std::string scene = k_square;
    const auto replace = [&](const std::string& from, const std::string& to) {
        scene.replace(scene.find(from), from.size(), to);
    };
    replace("\"flat\"", "\"phong\"");
    replace("color = [255, 51, 0]", "color = { texture = \"steps.ppm\", scale = [1, 0.5, 0.25] }");
    replace("ks = 0.0",
            "ks = [0.5, 0.25, 0]\nshininess = { texture = \"steps.ppm\", channel = \"g\", scale = 30, offset "
            "= 2 }");
    scene +=
        "[[object]]\ntype = \"cube\"\nsize = 0.2\nposition = [0, 0.6, 0.5]\nreflection = \"lambert\"\n"
        "[object.material]\nkd = 0.125\n";
    const Layers layers = render_layers(folder, scene, "color,material");
    // The face of a metre is seen from four metres, through 20 degrees.
    const double width = 60 / (8 * std::tan(10 * 3.14159265358979 / 180));
    for (const int x : {16, 21, 30, 38, 43}) {
        INFO(x);
        const double u = 0.5 + (x + 0.5 - 30) / width;
        const double texel = (4 * u - 0.5) / 3;  // linear between the centres of the texels
        CHECK(layers.at("color.R", x, 30) == Approx(texel).margin(2e-4));
        CHECK(layers.at("color.G", x, 30) == Approx(0.5 * texel).margin(2e-4));
        CHECK(layers.at("color.B", x, 30) == Approx(0.25 * texel).margin(2e-4));
        CHECK(layers.at("material.shininess", x, 30) == Approx(2 + 30 * texel).margin(6e-3));
        CHECK(layers.at("material.kd.R", x, 30) == Approx(0.8));
        CHECK(layers.at("material.ks.R", x, 30) == 0.5f);
        CHECK(layers.at("material.ks.G", x, 30) == 0.25f);
    }
    // Lambert's model has neither.
    CHECK(layers.at("material.kd.R", 30, 2) == 0.125f);
    CHECK(layers.at("material.ks.R", 30, 2) == 0);
    CHECK(layers.at("material.shininess", 30, 2) == 0);
    CHECK(layers.at("material.shininess", 1, 30) == 0);
}

TEST_CASE("terms add up to the picture, and so do lights, surroundings and background") {
    const Layers layers =
        render_layers(scratch_directory(), k_many, "ambient,diffuse,specular,light,surroundings,background");
    const std::vector<std::string> terms{"ambient", "diffuse", "specular", "background"};
    const std::vector<std::string> lights{"light.lamp", "light.1",      "light.2",   "light.3",
                                          "light.4",    "surroundings", "background"};
    for (const std::string channel : {"R", "G", "B"}) {
        double shown = 0;
        for (int y = 0; y < layers.height; ++y) {
            for (int x = 0; x < layers.width; ++x) {
                const auto sum = [&](const std::vector<std::string>& names) {
                    double result = 0;
                    for (const std::string& name : names)
                        result += double{layers.at(name + "." + channel, x, y)};
                    return result;
                };
                const double image = double{layers.at(channel, x, y)};
                INFO(channel << " at " << x << ", " << y);
                REQUIRE(sum(terms) == Approx(image).margin(2e-6).epsilon(2e-6));
                REQUIRE(sum(lights) == Approx(image).margin(2e-6).epsilon(2e-6));
                shown += double{layers.at("surroundings." + channel, x, y)};
            }
        }
        CHECK(shown > 0);
    }
}

TEST_CASE("what surfaces emit is a term of its own, which no light has, also where they cover only a part") {
    std::string scene = k_many;
    scene +=
        "\n[[object]]\nname = \"lamp\"\ntype = \"sphere\"\nradius = 0.4\nposition = [0, 0.6, 1.5]\n"
        "shading = \"phong\"\nreflection = \"lambert\"\n[object.material]\nemission = [51, 102, "
        "255]\nemission_strength = 3\n";
    // Seen through both sides of the ball, three quarters of it.
    const auto [opacity, share] =
        GENERATE(std::pair{"opacity = 1\n", 1.0}, std::pair{"opacity = 0.5\n", 0.75});
    scene += opacity;
    const Layers layers = render_layers(scratch_directory(), scene,
                                        "ambient,diffuse,specular,light,surroundings,background,emission");
    const std::vector<std::string> terms{"ambient", "diffuse", "specular", "background", "emission"};
    const std::vector<std::string> lights{"light.lamp", "light.1",      "light.2",    "light.3",
                                          "light.4",    "surroundings", "background", "emission"};
    double emitted = 0;
    for (int y = 0; y < layers.height; ++y) {
        for (int x = 0; x < layers.width; ++x) {
            for (const auto& names : {terms, lights}) {
                double sum = 0;
                for (const std::string& name : names) sum += double{layers.at(name + ".G", x, y)};
                REQUIRE(sum == Approx(double{layers.at("G", x, y)}).margin(2e-6).epsilon(2e-6));
            }
            emitted = std::max(emitted, double{layers.at("emission.G", x, y)});
        }
    }
    CHECK(emitted == Approx(share * 3 * std::pow((102 / 255.0 + 0.055) / 1.055, 2.4)).epsilon(1e-5));
}

TEST_CASE("the term opacity is that of the nearest surface that is there, before anything is covered") {
    const auto folder = scratch_directory();
    const std::string behind =
        "[[object]]\ntype = \"cube\"\nsize = 0.4\nposition = [0, 0, -3]\n[object.material]\nopacity = 0.75\n";
    const auto in_the_middle = [&](const std::string& opacity) {
        return render_layers(folder, k_square + opacity + behind, "opacity").at("opacity", 30, 30);
    };
    // Of the nearer cube, the back is seen as well.
    CHECK(in_the_middle("opacity = 0.25\n") == 0.25f);
    CHECK(in_the_middle("opacity = 0.25\nopacity_cutoff = 0.125\n") == 1);
    CHECK(in_the_middle("opacity = 0.25\nopacity_cutoff = 0.5\n") == 0.75f);
    SECTION("as a texture says at the middle of a pixel") {
        // The opacity rises along u by 30 of 255 from the middle of one texel to that of the next.
        std::string ramp = "P6\n8 1\n255\n";
        for (int i = 0; i < 8; ++i) ramp.append(3, static_cast<char>(30 * i));
        write_file(folder / "ramp.ppm", ramp);
        const Layers layers = render_layers(
            folder, std::string(k_square) + "opacity = { texture = \"ramp.ppm\" }\n", "uv,opacity");
        int compared = 0;
        for (int x = 0; x < layers.width; ++x) {
            const double along = 8 * double{layers.at("uv.U", x, 30)} - 0.5;
            if (along < 1 || along > 7) continue;
            CHECK(layers.at("opacity", x, 30) == Approx(30 * along / 255).epsilon(1e-3));
            ++compared;
        }
        CHECK(compared > 20);
    }
    SECTION("and grey in files of bytes") {
        write_file(folder / "scene.toml", std::string(k_square) + "opacity = 0.2\n");
        succeeded(run_candela({"render", (folder / "scene.toml").string(), "-o", (folder / "a.ppm").string(),
                               "--terms", "opacity", "--quiet"}));
        const std::string ppm = read_file(folder / "a.opacity.ppm");
        const auto level = [&](std::size_t x) {
            return static_cast<int>(
                static_cast<unsigned char>(ppm[ppm.size() - std::size_t{60 * 60 * 3} + 3 * (60 * 30 + x)]));
        };
        CHECK(level(30) == 51);
        CHECK(level(1) == 0);
    }
}

TEST_CASE("geometric terms are those at the centre of each pixel, whatever the number of samples") {
    const auto folder = scratch_directory();
    const std::string terms = "depth,position,face_normal,barycentric,uv,opacity,facing,object,triangle";
    std::string one = k_many;
    one.replace(one.find("samples = 4"), 11, "samples = 1");
    const Layers several = render_layers(folder, k_many, terms), single = render_layers(folder, one, terms);
    for (const auto& [name, values] : several.channels) {
        INFO(name);
        if (name != "R" && name != "G" && name != "B") CHECK(values == single.channels.at(name));
    }
}

TEST_CASE("terms of a format without layers are files next to the picture, mapped for viewing") {
    const auto folder = scratch_directory();
    const auto file = write_file(folder / "scene.toml", k_square);
    const CommandResult result = run_candela({"render", file.string(), "-o", (folder / "a.ppm").string(),
                                              "--terms", "diffuse,normal,depth,light"});
    INFO(result.err);
    REQUIRE(result.exit_code == 0);
    CHECK(holds(result.err, "5 terms in files next to it"));
    const auto pixel = [&](const std::string& name, int x, int y) {
        const std::string ppm = read_file(folder / name);
        const std::size_t head = ppm.size() - std::size_t{60 * 60 * 3};
        const std::size_t at = head + 3 * static_cast<std::size_t>(60 * y + x);
        return std::vector<int>{static_cast<unsigned char>(ppm[at]), static_cast<unsigned char>(ppm[at + 1]),
                                static_cast<unsigned char>(ppm[at + 2])};
    };
    CHECK(pixel("a.diffuse.ppm", 30, 30) == std::vector{204, 41, 0});
    CHECK(pixel("a.light.sun.ppm", 30, 30) == std::vector{204, 41, 0});
    CHECK(pixel("a.normal.ppm", 30, 30) == std::vector{128, 128, 255});
    CHECK(pixel("a.normal.ppm", 1, 30) == std::vector{0, 0, 0});
    CHECK(pixel("a.depth.ppm", 30, 30) == std::vector{255, 255, 255});
    CHECK(pixel("a.depth.ppm", 1, 30) == std::vector{0, 0, 0});
    CHECK(fs::exists(folder / "a.light.sky.ppm"));
    CHECK(std::distance(fs::directory_iterator(folder), fs::directory_iterator{}) == 7);
}

TEST_CASE("terms do not depend on the number of threads") {
    const auto folder = scratch_directory();
    const auto file = write_file(folder / "scene.toml", k_many);
    std::vector<std::string> images;
    for (const char* const threads : {"1", "3"}) {
        const auto image = folder / (std::string(threads) + ".exr");
        succeeded(run_candela({"render", file.string(), "-o", image.string(), "--terms", "all", "--threads",
                               threads, "--quiet"}));
        images.push_back(read_file(image));
    }
    CHECK(images[0] == images[1]);
}

TEST_CASE("an unknown or unwritable term is an error that lists the possible ones, without a file") {
    const auto folder = scratch_directory();
    const auto file = write_file(folder / "scene.toml", k_square);
    const auto error = [&](const std::string& terms, const std::string& output,
                           const std::string& scene = {}) {
        if (!scene.empty()) write_file(file, scene);
        const CommandResult result =
            run_candela({"render", file.string(), "-o", output, "--terms", terms, "--no-clobber"});
        CHECK(std::distance(fs::directory_iterator(folder), fs::directory_iterator{}) == 1);
        INFO(result.err);
        CHECK(result.exit_code == 2);
        return result.err;
    };
    const std::string image = (folder / "a.png").string();
    CHECK(
        holds(error("difuse", image), "--terms: unknown term 'difuse'; did you mean 'diffuse'?; possible: "));
    CHECK(holds(error("light.son", image), "unknown term 'light.son'; did you mean 'light.sun'?"));
    CHECK(holds(error("diffuse,", image), "unknown term ''"));
    CHECK(holds(error("diffuse", "-"), "--terms writes layers, or files next to the picture"));
    std::string slashes = k_square;
    slashes.replace(slashes.find("\"sun\""), 5, "\"a/b\"");
    slashes.replace(slashes.find("\"sky\""), 5, "\"a b\"");
    CHECK(holds(error("light", image, slashes), "would both be written to"));
}
