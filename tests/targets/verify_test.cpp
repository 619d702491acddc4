// candela verify notices deviations.
#include <fmt/format.h>

#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "support/command.h"
#include "support/expect.h"
#include "support/text.h"

namespace fs = std::filesystem;

namespace {

void replace_in(const fs::path& file, const std::string& from, const std::string& to) {
    std::string text = read_file(file);
    const std::size_t at = text.find(from);
    INFO(from);
    REQUIRE(at != std::string::npos);
    write_file(file, text.replace(at, from.size(), to));
}

/// Runs in an environment with additional variables.
CommandResult verify_where(std::vector<std::pair<std::string, std::string>> environment,
                           const std::vector<std::string>& arguments) {
    // A warning here would reach users.
    environment.emplace_back("CXXFLAGS", "-Werror");
    return run_candela(joined({"verify"}, arguments), {.environment = std::move(environment)});
}

CommandResult verify(const std::vector<std::string>& arguments) { return verify_where({}, arguments); }

const std::vector<std::string> k_small = {"--width", "160", "--height", "120"};

/// The default scene's program with one thing in it changed.
CommandResult verify_changed(const std::string& target, const std::string& file, const std::string& from,
                             const std::string& to) {
    const fs::path program = scratch_directory() / "program";
    succeeded(run_candela(joined({"generate", "--target", target, "-o", program.string()}, k_small)));
    if (!from.empty()) replace_in(program / file, from, to);
    return verify(joined({"--target", target, "--program", program.string()}, k_small));
}

}  // namespace

#ifndef CANDELA_TEST_SANITIZED
TEST_CASE("verify: the default scene matches in C++, in OpenGL and in a browser, with a report") {
    const fs::path report = scratch_directory() / "report";
    const fs::path home = scratch_directory() / "home";
    fs::create_directories(home);
    const CommandResult result =
        expect(verify_where({{"HOME", home.string()}, {"XDG_CACHE_HOME", home.string()}},
                            {"--report", report.string()}),
               0);
    INFO("drivers and browsers leave nothing at home");
    CHECK(fs::is_empty(home));
    for (const char* const target : {"cpp", "opengl", "webgl"}) {
        CHECK(holds(result.out, target));
        CHECK(fs::exists(report / (std::string(target) + ".png")));
        CHECK(fs::exists(report / (std::string(target) + "-difference.png")));
    }
    CHECK_FALSE(holds(result.out, "MISMATCH"));
    CHECK(holds(read_file(report / "index.html"), "Verification of The default scene"));
}
#endif

TEST_CASE("verify: an unchanged program matches, even in a folder where it was generated before") {
    expect(verify_changed("cpp", "", "", ""), 0);
}

TEST_CASE("verify: a sign in one copy of a kernel is caught", "[programs]") {
    expect_out(verify_changed("cpp", "scene.cpp", "s.normal - to_light", "s.normal + to_light"), 4,
               {"MISMATCH"});
}

TEST_CASE("verify: a light that is displaced by five centimetres is caught", "[whole]") {
    expect(verify_changed("cpp", "scene.cpp", "PointLight{vec3(1.0f), 2.5f, vec3(0.0f)",
                          "PointLight{vec3(1.0f), 2.5f, vec3(0.05f, 0.0f, 0.0f)"),
           4);
}

TEST_CASE("verify: half Lambert instead of Lambert is caught, in GLSL", "[programs]") {
    expect(verify_changed("opengl", "scene.cpp", "max(n_dot_l, 0.0f)",
                          "(0.5f * n_dot_l + 0.5f) * (0.5f * n_dot_l + 0.5f)"),
           4);
}

TEST_CASE("verify: an object that is not drawn is caught", "[whole]") {
    expect(verify_changed("cpp", "scene.cpp", "all.push_back(o);", ""), 4);
}

TEST_CASE("verify: a wrong formula in a page is caught", "[programs]") {
    expect(verify_changed("webgl", "scene.html", "s.color * max(n_dot_l, 0.0f)",
                          "s.color * max(1.1f * n_dot_l, 0.0f)"),
           4);
}

TEST_CASE("verify: a program that does not compile or run is an error that shows the reason", "[programs]") {
    expect(verify_changed("cpp", "scene.cpp", "int main(", "int main(nonsense "), 1, {"nonsense"});
    expect(
        verify_changed("cpp", "scene.cpp", "const std::string path = argc > 1 ? argv[1] : \"scene.png\";",
                       "const std::string path = std::string(argc > 1 ? argv[1] : \"\") + \"/no/folder\";"),
        1, {"cannot write"});
}

#ifdef CANDELA_TEST_FAULTY_PLUGINS
TEST_CASE("verify: a plugin whose kernel differs from its code is caught") {
    expect(verify({"--target", "cpp", "--plugin-dir", CANDELA_TEST_FAULTY_PLUGINS, "--reflection",
                   "says-otherwise", "--width", "120"}),
           4);
}
#endif

namespace {

/// A plain grey picture from every program of this target.
CommandResult verify_grey(const std::vector<std::string>& more) {
    const fs::path program = scratch_directory() / "grey";
    succeeded(run_candela(joined({"generate", "--target", "cpp", "-o", program.string()}, k_small)));
    replace_in(program / "scene.cpp", "255.0f * encoded(std::min(std::max(x, 0.0f), 1.0f)) + 0.5f",
               "127.0f + 0 * x");
    return verify(joined(joined({"--target", "cpp", "--program", program.string()}, k_small), more));
}

}  // namespace

TEST_CASE("verify: a tolerance of 0 does not make every pixel an edge", "[programs]") {
    expect(verify_grey({"--tolerance", "0"}), 4);
    expect(verify_changed("cpp", "", "", ""), 0);
}

TEST_CASE("verify: a program that draws nothing does not pass with a picture of an earlier report",
          "[programs]") {
    const fs::path directory = scratch_directory(), report = directory / "report", program = report / "cpp";
    const Words words = joined({"--target", "cpp", "--report", report.string()}, k_small);
    REQUIRE(verify(words).exit_code == 0);
    REQUIRE(fs::exists(report / "cpp.png"));
    write_file(program / "scene.cpp", "int main() {}\n");
    expect_out(verify(joined(words, {"--program", program.string()})), 4,
               {"ended without writing a picture"});
    CHECK_FALSE(fs::exists(report / "cpp.png"));
    CHECK(holds(read_file(report / "index.html"), "ended without writing a picture"));
}

TEST_CASE("verify: a picture of another size is reported as such", "[programs]") {
    expect_out(
        verify_changed("cpp", "scene.cpp", "k_width = 160, k_height = 120", "k_width = 80, k_height = 60"), 4,
        {"80 x 60"});
}

TEST_CASE("verify: if hardly a pixel is away from edges, there is no verdict, but advice", "[programs]") {
    for (const std::string& size : {std::string("12"), std::string("30")}) {
        expect_out(verify({"--target", "cpp", "--width", size, "--height", size}), 4,
                   {"UNDECIDED", "--width"});
    }
}

TEST_CASE("verify: --json has the figures, and the number of pixels that the verdict rests on",
          "[programs]") {
    const CommandResult result = succeeded(verify(joined({"--target", "cpp", "--json"}, k_small)));
    const auto json = nlohmann::json::parse(result.out);
    REQUIRE(json.size() == 1);
    CHECK(json[0].at("target") == "cpp");
    CHECK(json[0].at("outcome") == "match");
    const std::size_t shown = json[0].at("shown").at("pixels"),
                      away = json[0].at("shown").at("away_from_edges");
    CHECK(away >= 1000);
    CHECK(shown > away);
    // The other pixels are background.
    CHECK(shown < json[0].at("comparison").at("interior").at("pixels"));
    for (const char* const figure : {"gain", "right", "down", "zoom", "region"})
        CHECK(std::abs(json[0].at("bias").at(figure).at("value").get<double>()) < 1e-3);
}

#ifndef CANDELA_TEST_SANITIZED
TEST_CASE("verify: near objects are drawn in all programs, however far the scene extends", "[whole]") {
    // Spheres of a fifth of a metre and of 40 km: depths from 0.6 to 200,000 metres.
    const fs::path scene = write_file(scratch_directory() / "far.toml", R"(version = 1
room = {width = 1e6, height = 1e6, depth = 1e6}
observer = {position = [0, 0, 1], look_at = [0, 0, 0]}
image = {width = 160, height = 120}
shading = {model = "phong"}
reflection = {model = "lambert"}
light = [{type = "directional", direction = [-1, -1, -1]}]
object = [
    {type = "sphere", radius = 0.2, segments = 64, color = [220, 120, 60]},
    {type = "sphere", radius = 40000, segments = 64, position = [60000, 0, -150000], color = [80, 160, 220]},
]
)");
    expect(verify({scene.string()}), 0);
}
#endif

#ifndef CANDELA_TEST_SANITIZED
namespace {

void expect_match(const fs::path& name, const std::string& text) {
    const fs::path scene = write_file(scratch_directory() / name, text);
    const CommandResult result = verify({scene.string()});
    INFO(name << "\n" << result.out << result.err);
    CHECK(result.exit_code == 0);
}

}  // namespace

TEST_CASE("verify: a thousand lights match in C++, in OpenGL and in a browser", "[whole]") {
    std::string text = R"(version = 1
observer = {position = [0.4, 1.1, 3.6], look_at = [0, -0.1, 0], fov = 38}
image = {width = 96, height = 72}
shading = {model = "phong"}
reflection = {model = "phong"}
object = [
    {type = "sphere", radius = 0.6, segments = 24, position = [-0.6, -0.2, 0]},
    {type = "cube", size = 0.7, position = [0.7, -0.3, 0], shading = "gouraud"},
]
)";
    for (int i = 0; i < 1000; ++i) {
        // A spiral in which the golden angle keeps neighbours apart.
        const double angle = 2.399963 * i, radius = 0.3 + 1.7 * std::sqrt(i / 1000.0);
        text += fmt::format(
            "[[light]]\ntype = \"{}\"\nposition = [{:.4f}, {:.4f}, {:.4f}]\nintensity = 0.003\n"
            "color = [{}, {}, {}]\n{}",
            i % 5 == 0 ? "spot" : "point", radius * std::cos(angle), 1.5 + 0.0007 * i,
            radius * std::sin(angle), 37 * i % 256, 91 * i % 256, 53 * i % 256,
            i % 5 == 0 ? "direction = [0, -1, 0]\n" : "");
    }
    expect_match("thousand.toml", text);
}

TEST_CASE("verify: a picture narrower than the observer's frame matches in C++, in OpenGL and in a browser",
          "[whole]") {
    for (const char* const projection : {"fov = 30", "projection = \"orthographic\", height = 1.6"})
        expect_match("narrow.toml", fmt::format(R"(version = 1
observer = {{position = [0.4, 1.1, 3.6], look_at = [0, -0.1, 0], {}, frame_aspect = 1.5}}
image = {{width = 80, height = 160}}
shading = {{model = "phong"}}
reflection = {{model = "phong"}}
light = [{{type = "point", position = [1, 2, 3], intensity = 9}}]
object = [
    {{type = "sphere", radius = 0.5, segments = 24, position = [-0.6, -0.2, 0]}},
    {{type = "cube", size = 0.7, position = [0.7, -0.3, 0], shading = "gouraud"}},
]
)",
                                                projection));
}

TEST_CASE("verify: where the last bits of N.L decide on a step of brightness, correct programs match",
          "[whole]") {
    // Two of the cube's faces are parallel to the light, so that N.L is 0 except for rounding.
    expect_match("parallel.toml", R"(version = 1
observer = {position = [0.77, 1.13, 4.5], look_at = [0, 0, 0], projection = "orthographic", height = 1.8}
image = {width = 120, height = 100, samples = 4, color_management = "none"}
shading = {model = "flat"}
reflection = {model = "toon"}
light = [
    {type = "ambient", intensity = 0.3},
    {type = "directional", direction = [1, -1, -1], intensity = 0.6},
    {type = "point", position = [1.6, 2.4, 2], intensity = 9},
]
object = [{type = "cube", size = 0.8, rotation = [0, 45, 0], color = [139, 85, 246], material = {bands = 1, highlight = 20}}]
)");
}

TEST_CASE("verify: where N.H is 1 except for rounding, no program draws a highlight of 0 degrees",
          "[whole]") {
    // Light and observer are in the same direction, and the centre of the sphere's disc faces both.
    expect_match("none.toml", R"(version = 1
observer = {position = [2.1, 1.3, 2.9], look_at = [0, 0, 0], projection = "orthographic", height = 3}
image = {width = 160, height = 120, color_management = "none"}
shading = {model = "phong"}
reflection = {model = "toon"}
light = [{type = "directional", direction = [-2.1, -1.3, -2.9], intensity = 0.6}]
object = [{type = "sphere", radius = 1, segments = 64, color = [139, 85, 246], material = {bands = 1, highlight = 0}}]
)");
}

TEST_CASE("verify: a spot's cone and a highlight's rim are as exact in shaders as in C++", "[whole]") {
    expect_match("cone.toml", R"(version = 1
observer = {position = [-0.21, 1.37, 4.5], look_at = [0, 0, 0], fov = 42}
image = {width = 240, height = 160, color_management = "none"}
shading = {model = "flat"}
reflection = {model = "toon"}
light = [
    {type = "ambient", intensity = 0.3},
    {type = "directional", direction = [-1, -1, -2], intensity = 0.6},
    {type = "spot", position = [0, 2.4, 2], direction = [0, -1, -0.8], intensity = 9, inner_angle = 15, outer_angle = 35},
]
[[object]]
type = "sphere"
radius = 0.6
segments = 8
position = [-1.6, -0.15, 0]
color = [167, 132, 232]
material = {bands = 3, highlight = 30}
)");
    expect_match("rim.toml", R"(version = 1
observer = {position = [-1.13, 1.17, 4.5], look_at = [0, 0, 0], fov = 42}
image = {width = 240, height = 160}
shading = {model = "flat"}
reflection = {model = "toon"}
light = [
    {type = "ambient", intensity = 0.3},
    {type = "spot", position = [0, 2.4, 2], direction = [0, -1, -0.8], intensity = 9, inner_angle = 15, outer_angle = 35},
    {type = "directional", direction = [0, -1, -1], intensity = 0.6},
]
[[object]]
type = "torus"
major_radius = 0.45
minor_radius = 0.2
segments = 32
position = [1.6, 0.06, 0]
color = [132, 182, 205]
material = {bands = 5, highlight = 10}
)");
}
#endif

TEST_CASE("verify: wrong arguments are usage errors with a way out") {
    CHECK(holds(verify({"--target", "webg"}).err, "did you mean 'webgl'?"));
    CHECK(verify({"--target", "webg"}).exit_code == 2);
    CHECK(verify({"--tolerance", "-1"}).exit_code == 2);
    CHECK(verify({"--program", "x"}).exit_code == 2);
    CHECK(verify({"--target", "cpp", "--set", "light.lamp.intensity=-1"}).exit_code == 3);
}
