// Pages with three.js, read as a browser reads them and drawn by one.
#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "support/command.h"
#include "support/expect.h"
#include "support/floor_scene.h"
#include "support/folder.h"

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::json;

/// Call this first: within CHECK() and REQUIRE(), SKIP() is a failure.
void require_three() {
    if (!fs::exists(fs::path(CANDELA_TEST_PLUGINS) / "target-three"))
        SKIP("three.js is missing; scripts/three.sh fetches it");
}

/// The scene within the page.
Json generated(const Folder& folder, const std::string& scene) {
    folder.write("scene.toml", scene);
    succeeded(folder.run("generate scene.toml --target three -o made --quiet"));
    const std::string page = folder.read("made/scene.html");
    const std::string begin = "id=\"scene\">";
    const std::size_t at = page.find(begin) + begin.size();
    return Json::parse(page.substr(at, page.find("</script>", at) - at));
}

/// The middle pixel of the picture that the page draws, in levels.
std::array<int, 3> drawn_in_the_middle(const Folder& folder, const std::string& scene) {
    folder.write("scene.toml", scene);
    const CommandResult result = folder.run("verify scene.toml --target three --report report");
    INFO(result.out << result.err);
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    REQUIRE(png_image_begin_read_from_file(&image, (folder / "report/three.png").c_str()) != 0);
    image.format = PNG_FORMAT_RGB;
    std::vector<png_byte> bytes(PNG_IMAGE_SIZE(image));
    REQUIRE(png_image_finish_read(&image, nullptr, bytes.data(), 0, nullptr) != 0);
    const std::size_t width = image.width, middle = 3 * (width * (image.height / 2) + width / 2);
    return {bytes[middle], bytes[middle + 1], bytes[middle + 2]};
}

std::array<int, 3> grey(double intensity) {
    const int level = static_cast<int>(std::lround(255 * intensity));
    return {level, level, level};
}

bool is_near(const Json& a, double b) {
    return std::abs(a.get<double>() - b) <= 1e-5 * std::max(1.0, std::abs(b));
}

const std::string k_head = R"(version = 1
shading = {model = "phong"}
reflection = {model = "lambert"}
observer = {position = [0, 0, 4], look_at = [0, 0, 0]}
image = {width = 64, height = 48}
)";
const std::string k_point = "[[light]]\ntype = \"point\"\nposition = [0, 3, 2]\nintensity = 7\n";
const std::string k_ball =
    "[[object]]\ntype = \"sphere\"\nradius = 0.5\ncolor = [255, 255, 255]\n"
    "material = {kd = [0.5, 1, 0.25], ka = 0.5}\n";

/// A white wall in z = 0, seen at its origin.
std::string wall(const std::string& light) {
    return R"(version = 1
shading = {model = "phong"}
reflection = {model = "lambert"}
observer = {position = [0, 0, 4], look_at = [0, 0, 0], projection = "orthographic", height = 0.01}
image = {width = 9, height = 9, color_management = "none"}
)" + light +
           "[[object]]\ntype = \"mesh\"\nfile = \"wall.obj\"\ncolor = [255, 255, 255]\n"
           "material = {kd = 1, ka = 0.5}\n";
}

Folder folder_with_wall() { return {{"wall.obj", "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n"}}; }

}  // namespace

TEST_CASE(
    "target/three: three.js draws RE example 2 with its own material and with a kernel: 0.7071 and 0.8575",
    "[programs]") {
    require_three();
    const Folder folder({{"floor.obj", k_floor_obj}});
    const std::string own = floor_scene("lambert", "ka = 0\nkd = 1\n");
    CHECK(generated(folder, own)["objects"][0]["lambert"].is_object());
    CHECK(drawn_in_the_middle(folder, own) == grey(0.7071));
    const std::string kernel = floor_scene("phong", "ka = 0\nkd = 0\nks = 1\nshininess = 1\n");
    CHECK(drawn_in_the_middle(folder, kernel) == grey(0.8575));
}

TEST_CASE("target/three: three.js's own lights light a wall as strongly as computed by hand", "[whole]") {
    require_three();
    const Folder folder = folder_with_wall();
    // 2 / 2^2 before it, N.L 0.8 of 0.25 from the sun, and ka 0.5 of 0.2.
    const std::string lights = wall(
        "[[light]]\ntype = \"point\"\nposition = [0, 0, 2]\nintensity = 2\n"
        "[[light]]\ntype = \"directional\"\ndirection = [0, -0.6, -0.8]\nintensity = 0.25\n"
        "[[light]]\ntype = \"ambient\"\nintensity = 0.2\n");
    CHECK(generated(folder, lights)["objects"][0]["lambert"].is_object());
    CHECK(drawn_in_the_middle(folder, lights) == grey(0.5 + 0.2 + 0.1));
    // Halfway between the cosines of 10 and 40 degrees a smoothstep is 1/2: 3.2 / 2^2 of it.
    const std::string spot = wall(
        "[[light]]\ntype = \"spot\"\nposition = [0, 0, 2]\ndirection = [0.48336, 0, -0.87543]\n"
        "inner_angle = 10\nouter_angle = 40\nintensity = 3.2\n");
    CHECK(generated(folder, spot)["objects"][0]["lambert"].is_object());
    CHECK(drawn_in_the_middle(folder, spot) == grey(0.4));
}

TEST_CASE("target/three: three.js's lights and materials have the figures computed by hand") {
    require_three();
    const Json page = generated(Folder(), k_head + k_point + R"([[light]]
type = "spot"
position = [0, 4, 0]
direction = [0, -2, 0]
inner_angle = 15
outer_angle = 30
[[light]]
type = "ambient"
color = [255, 255, 255]
intensity = 0.25
)" + k_ball);
    const Json& point = page["lights"][0];
    CHECK(point["type"] == "point");
    CHECK(point["color"] == Json{7, 7, 7});
    CHECK(is_near(point["intensity"], std::numbers::pi));  // its materials reflect with 1 / pi
    CHECK(point["decay"] == 2);
    const Json& spot = page["lights"][1];
    CHECK(spot["type"] == "spot");
    CHECK(is_near(spot["angle"], std::numbers::pi / 6));
    CHECK(is_near(spot["penumbra"], 0.5));
    CHECK(spot["target"] == Json{0, 3, 0});
    CHECK(page["objects"][0]["lambert"]["color"] == Json{0.5, 1, 0.25});
    CHECK(page["objects"][0]["lambert"]["emissive"] == Json{0.125, 0.125, 0.125});
}

TEST_CASE("target/three: a kernel takes numbers of its material from textures", "[programs]") {
    require_three();
    Folder folder = folder_with_wall();
    folder.write(
        "wall.obj",
        "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n");
    // The transform puts the centre of the first texel in the middle.
    folder.write("p.ppm", std::string("P6\n4 1\n255\n\x33\x66\xcc") + std::string(9, '\xff'));
    std::string scene = wall("[[light]]\ntype = \"directional\"\ndirection = [0, 0, -1]\n");
    const std::string constant = "kd = 1, ka = 0.5";
    scene.replace(scene.find(constant), constant.size(),
                  "ka = 0, kd = { texture = \"p.ppm\", channel = \"b\", scale = 0.75, wrap = \"clamp\", "
                  "transform = { scale = [0.01, 1], offset = [0.12, 0] } }");
    CHECK(generated(folder, scene)["objects"][0]["lambert"].is_null());
    CHECK(drawn_in_the_middle(folder, scene) == grey(0.75 * 204 / 255));
}

TEST_CASE("target/three: a wall covers its opacity's part of a wall behind it and of the background",
          "[programs]") {
    require_three();
    const Folder folder = folder_with_wall();
    const auto scene = [](const std::string& behind) {
        return wall("[[light]]\ntype = \"ambient\"\nintensity = 1\n") + behind +
               "[[object]]\ntype = \"mesh\"\nfile = \"wall.obj\"\nposition = [0, 0, 1]\ncolor = [255, 255, "
               "255]\nmaterial = { ka = 0.8, kd = 0, opacity = 0.25 }\n";
    };
    // Of the two, the nearer comes last.
    CHECK(drawn_in_the_middle(folder, scene("")) == grey(0.25 * 0.8 + 0.75 * 0.5));
    const std::string between =
        "[[object]]\ntype = \"mesh\"\nfile = \"wall.obj\"\nposition = [0, 0, 0.5]\ncolor = [255, 255, "
        "255]\nmaterial = { ka = 0.2, kd = 0, opacity = 0.5 }\n";
    CHECK(drawn_in_the_middle(folder, scene(between)) == grey(0.25 * 0.8 + 0.75 * (0.5 * 0.2 + 0.5 * 0.5)));
    CHECK_FALSE(generated(folder, scene(""))["objects"][0]["lambert"].is_object());
}

TEST_CASE("target/three: kernels compute what three.js computes differently", "[whole]") {
    require_three();
    const Folder folder;
    const auto is_own = [&](const std::string& scene) {
        return generated(folder, scene)["objects"][0]["lambert"].is_object();
    };
    CHECK(is_own(k_head + k_point + k_ball));
    CHECK_FALSE(is_own(k_head + k_point + "attenuation = \"offset-linear\"\n" + k_ball));
    CHECK_FALSE(is_own(k_head + k_point + "[[light]]\ntype = \"hemisphere\"\n" + k_ball));
    CHECK_FALSE(is_own(k_head +
                       "[[light]]\ntype = \"spot\"\nposition = [0, 3, 2]\ndirection = [0, -1, 0]\n"
                       "falloff = \"linear\"\n" +
                       k_ball));
    // Within a tenth of a metre, three.js's lights do not fade.
    CHECK_FALSE(is_own(k_head + "[[light]]\ntype = \"point\"\nposition = [0, 0.55, 0]\n" + k_ball));
    CHECK(is_own(k_head + "[[light]]\ntype = \"point\"\nposition = [0, 0.65, 0]\n" + k_ball));
    CHECK_FALSE(is_own(k_head + k_point + k_ball + "reflection = \"phong\"\n"));
    for (const std::string& shading : {"flat", "gouraud", "derivative"})
        CHECK_FALSE(is_own(k_head + k_point + k_ball + "shading = \"" + shading + "\"\n"));
}

TEST_CASE("target/three: an open mesh with colours at its vertices is correct from both sides", "[whole]") {
    require_three();
    const Folder folder;
    folder.write("roof.obj",
                 "v -1 -1 0 1 0.2 0.2\nv 1 -1 0 0.2 1 0.2\nv 1 1 0 0.2 0.2 1\nv -1 1 0 1 1 1\n"
                 "f 1 2 3\nf 1 3 4\n");
    for (const std::string& light : {k_point, k_point + "[[light]]\ntype = \"ambient\"\n"}) {
        std::string objects;
        for (const auto& [turn, x] : {std::pair{20, -0.7}, {200, 0.7}})
            objects += fmt::format(
                "[[object]]\ntype = \"mesh\"\nfile = \"roof.obj\"\nrotation = [0, {}, 0]\n"
                "scale = [0.6, 0.6, 0.6]\nposition = [{}, 0, 0]\n",
                turn, x);
        folder.write("scene.toml", k_head + light + objects);
        expect(folder.run("verify scene.toml --target three --tolerance 1 --width 200 --height 120"), 0);
    }
}

TEST_CASE("target/three: without three.js, the error says which files belong where") {
    const Folder folder;
    const fs::path plugins = CANDELA_TEST_PLUGINS;
    for (const char* const name : {"target-three.so", "target-three.json"})
        fs::copy_file(plugins / name, folder / name, fs::copy_options::overwrite_existing);
    expect(folder.run("generate --target three --plugin-dir . -o made"), 1,
           {"three.js is missing", "npm pack three@", (folder / "target-three").string()});
    CHECK_FALSE(folder.has("made"));
}
