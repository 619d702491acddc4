#include <catch2/catch_approx.hpp>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "console/diagnostics_text.h"
#include "support/command.h"
#include "support/plugins.h"
#include "support/scene_tables.h"
#include "support/text.h"

using candela::Diagnostic;
using candela::Scene;
using candela::Severity;
using candela::Vec3;

namespace {

std::string whole() { return k_start + k_models + k_light + k_cube; }

struct Result {
    std::optional<Scene> scene;
    std::vector<Diagnostic> found;
    std::string text;
};

Result read(const candela::SceneRequest& request) {
    candela::Diagnostics diagnostics;
    Result result;
    result.scene = candela::read_scene(request, test_registry(), diagnostics);
    result.found = diagnostics.sorted();
    result.text = diagnostics_text(diagnostics, false);
    return result;
}

Result read(const std::string& text, candela::SceneRequest request = {}) {
    request.files = {write_file(scratch_directory() / "scene.toml", text)};
    return read(request);
}

/// Checks the line and column of the only error, and that its message contains `part`.
void check_error(const std::string& text, int line, int column, const std::string& part) {
    const Result result = read(text);
    INFO(result.text);
    CHECK_FALSE(result.scene);
    REQUIRE(result.found.size() == 1);
    CHECK(result.found[0].severity == Severity::error);
    CHECK(result.found[0].place.line == line);
    CHECK(result.found[0].place.column == column);
    CHECK(holds((result.found[0].message + " " + result.found[0].hint), part));
}

}  // namespace

TEST_CASE(
    "the default scene is one cube, one point light in the centre of the room, Phong and Phong (R12, R14)") {
    const Result result = read(candela::SceneRequest{});
    INFO(result.text);
    REQUIRE(result.scene);
    CHECK(result.found.empty());
    REQUIRE(result.scene->objects.size() == 1);
    REQUIRE(result.scene->lights.size() == 1);
    CHECK(result.scene->objects[0].shape.name == "cube");
    CHECK(result.scene->objects[0].shading.name == "phong");
    CHECK(result.scene->objects[0].reflection.name == "phong");
    CHECK(result.scene->lights[0].model.name == "point");
    CHECK(std::get<Vec3>(result.scene->lights[0].model.parameters.get("position")) == Vec3{});
    CHECK(result.scene->room.height == 10);
}

TEST_CASE("all values of a scene are read") {
    const Result result = read(R"(version = 1
[room]
height = 5
width = 6.5
depth = 7
[observer]
position = [0, 1, 2]
look_at = [0, 0, 0]
up = [0, 0, -2]
projection = "orthographic"
height = 3
[image]
width = 320
height = 200
samples = 8
background = [1, 2, 3]
color_management = "none"
[shading]
model = "flat"
[reflection]
model = "lambert"
[[light]]
name = "sun"
type = "directional"
color = [255, 128, 0]
intensity = 2
direction = [0, -3, 0]
[[object]]
name = "ball"
type = "sphere"
radius = 0.25
segments = 12
position = [1, 2, 3]
rotation = [10, 20, 30]
scale = 2
color = [9, 8, 7]
shading = "gouraud"
reflection = "blinn-phong"
[object.material]
ka = 0.2
kd = [0.1, 0.2, 0.3]
ks = 0.5
shininess = 7
[[object]]
type = "torus"
scale = [1, 2, 3]
)");
    INFO(result.text);
    REQUIRE(result.scene);
    const Scene& scene = *result.scene;
    CHECK(scene.room.width == 6.5f);
    CHECK(scene.observer.projection == candela::Projection::orthographic);
    CHECK(scene.observer.up == Vec3{0, 0, -1});
    CHECK(scene.observer.height == 3);
    CHECK(scene.image.samples == 8);
    CHECK(scene.image.background == Vec3{1, 2, 3});
    CHECK(scene.image.color_management == candela::ColorEncoding::none);
    REQUIRE(scene.objects.size() == 2);
    const candela::Object& ball = scene.objects[0];
    CHECK(ball.label.text() == "'ball'");
    CHECK(ball.transform.scale == Vec3{2, 2, 2});
    CHECK(ball.transform.rotation == Vec3{10, 20, 30});
    CHECK(ball.shading.name == "gouraud");
    CHECK(ball.reflection.name == "blinn-phong");
    CHECK(std::get<Vec3>(ball.reflection.parameters.get("ka")) == Vec3{0.2f, 0.2f, 0.2f});
    CHECK(std::get<Vec3>(ball.reflection.parameters.get("kd")) == Vec3{0.1f, 0.2f, 0.3f});
    CHECK(std::get<double>(ball.reflection.parameters.get("shininess")) == 7);
    CHECK(std::get<std::int64_t>(ball.shape.parameters.get("segments")) == 12);
    CHECK(scene.objects[1].shading.name == "flat");
    CHECK(scene.objects[1].reflection.name == "lambert");
    CHECK(scene.objects[1].transform.scale == Vec3{1, 2, 3});
    CHECK(scene.objects[1].label.text() == "number 1");
}

TEST_CASE("an unknown key is an error at its position, with a suggestion") {
    check_error(whole() + "[object.material]\nshinyness = 20\n", 16, 1, "did you mean 'shininess'?");
    check_error(whole() + "siz = 2\n", 15, 1, "did you mean 'size'?");
    check_error("vesrion = 1\n" + whole(), 1, 1, "did you mean 'version'?");
    check_error(whole() + "[imag]\nwidth = 3\n", 15, 2, "did you mean 'image'?");
}

TEST_CASE("a wrong type is an error that names the found and the expected type") {
    check_error(whole() + "color = \"red\"\n", 15, 9,
                "'color' is a string, \"red\"; expected three integers 0-255");
    check_error(whole() + "color = [1, 2.5, 3]\n", 15, 9, "a list whose second value is the number 2.5");
    check_error(whole() + "color = [1, 2]\n", 15, 9, "a list of 2 values");
    check_error(whole() + "size = true\n", 15, 8, "'size' is true; expected a number, greater than 0");
    check_error(whole() + "position = 3\n", 15, 12, "'position' is the integer 3; expected three numbers");
    check_error(whole() + "type2 = 1979-05-27\n", 15, 1, "unknown key 'type2'");
    check_error(whole() + "size = 1979-05-27\n", 15, 8, "'size' is a date or time");
    check_error(whole() + "material = 3\n", 15, 12, "expected the table [object.material]");
    check_error("version = 1\nlight = 3\n" + k_observer + k_models, 2, 1,
                "expected tables, each headed [[light]]");
    check_error("version = 1.0\n" + whole().substr(12), 1, 11, "expected the integer 1");
}

TEST_CASE("a value outside its range is an error that names the range") {
    check_error(whole() + "size = 0\n", 15, 8, "greater than 0");
    check_error(whole() + "color = [0, 257, 0]\n", 15, 9, "0 to 255");
    check_error(whole() + "color = [0, -1, 0]\n", 15, 9, "0 to 255");
    check_error(whole() + "[object.material]\nkd = 1.1\n", 16, 6, "0 to 1");
    check_error(whole() + "[object.material]\nkd = [0.1, 0.2, 1.5]\n", 16, 6, "0 to 1");
    check_error(whole() + "[object.material]\nshininess = -1\n", 16, 13, "at least 0");
    check_error(whole() + "size = 1e-50\n", 15, 8, "greater than 0");
    check_error(k_start + "fov = 179.9999999999\n" + k_models, 5, 7, "less than 180");
    check_error(whole() + "size = nan\n", 15, 8, "nan");
    check_error(whole() + "size = inf\n", 15, 8, "not a usable number");
    check_error(whole() + "size = 1e39\n", 15, 8, "too large");
    check_error(whole() + "scale = 0\n", 15, 9, "greater than 0");
    check_error(whole() + "[image]\nsamples = 2\n", 16, 11, "2 is not one of 1, 4, 8, 16");
    check_error(whole() + "[image]\nwidth = 65537\n", 16, 9, "1 to 65536");
    check_error(whole() + "[image]\ncolor_management = \"sRGB\"\n", 16, 20, "did you mean 'srgb'?");
    check_error(whole() + "[room]\nheight = 0\n", 16, 10, "greater than 0");
    check_error(k_start + "fov = 180\n" + k_models, 5, 7, "less than 180");
}

TEST_CASE("values just inside their range are accepted") {
    for (const char* const line :
         {"size = 1e-6\n", "color = [0, 255, 0]\n", "[object.material]\nkd = 1\nks = 0\n",
          "[object.material]\nkd = [0, 0.5, 0.7]\n", "[object.material]\nshininess = 0\n",
          "[image]\nsamples = 16\n", "[image]\nwidth = 65536\nheight = 1\n", "scale = [1, 2, 3]\n"}) {
        INFO(line);
        const Result result = read(whole() + line);
        INFO(result.text);
        CHECK(result.scene);
        CHECK(result.found.empty());
    }
}

TEST_CASE("256 as a colour means 255 and draws a warning (CA Table 1)") {
    const Result result = read(whole() + "color = [0, 256, 10]\n");
    REQUIRE(result.scene);
    CHECK(result.scene->objects[0].color == Vec3{0, 255, 10});
    REQUIRE(result.found.size() == 1);
    CHECK(result.found[0].severity == Severity::warning);
}

TEST_CASE("a surface that emits more light than it receives draws a warning (RE)") {
    const Result result = read(whole() + "[object.material]\nkd = 0.8\nks = 0.3\n");
    CHECK(result.scene);
    REQUIRE(result.found.size() == 1);
    CHECK(result.found[0].severity == Severity::warning);
    CHECK(holds(result.found[0].message, "kd + ks is 1.1"));
    CHECK(read(whole() + "[object.material]\nkd = 0.7\nks = 0.3\n").found.empty());
}

TEST_CASE("relations between two parameters are checked") {
    check_error(
        whole() +
            "[[light]]\ntype = \"spot\"\nposition = [0, 1, 0]\ndirection = [0, -1, 0]\ninner_angle = 30\n",
        19, 15, "must not exceed outer_angle");
    check_error(whole() + "[[object]]\ntype = \"torus\"\nminor_radius = 0.5\n", 17, 16,
                "must be less than major_radius");
}

TEST_CASE("a missing required key or table is an error") {
    check_error(k_observer + k_models + k_light + k_cube, 0, 0, "version = 1");
    check_error("version = 1\n" + k_models + k_light + k_cube, 0, 0, "no [observer]");
    check_error("version = 1\n[observer]\nposition = [0, 0, 1]\n", 2, 2, "[observer] has no 'look_at'");
    check_error(whole() + "[[light]]\ntype = \"point\"\n", 15, 1, "[[light]] number 1 has no 'position'");
    check_error(whole() + "[[object]]\nsize = 2\n", 15, 1, "has no 'type'");
    check_error(whole() + "[[object]]\ntype = \"mesh\"\n", 15, 1, "has no 'file'");
    check_error("version = 2\n" + whole().substr(12), 1, 11, "version 2");
}

TEST_CASE("an unknown plugin is an error with a suggestion") {
    check_error(whole() + "[[object]]\ntype = \"cub\"\n", 16, 8, "did you mean 'cube'?");
    check_error(whole() + "[[light]]\ntype = \"points\"\n", 16, 8, "did you mean 'point'?");
    check_error(whole() + "shading = \"fong\"\n", 15, 11, "no shading plugin is called 'fong'");
    check_error(whole() + "reflection = \"lambret\"\n", 15, 14, "did you mean 'lambert'?");
    check_error(k_start + "[shading]\nmodel = \"smooth\"\n[reflection]\nmodel = \"phong\"\n" + k_cube, 6, 9,
                "no shading plugin is called 'smooth'");
}

TEST_CASE("an empty name is not a model, nor a request for the default") {
    check_error(whole() + "shading = \"\"\n", 15, 11, "no shading plugin is called ''");
    check_error(whole() + "reflection = \"\"\n", 15, 14, "no reflection plugin is called ''");
    candela::SceneRequest request;
    request.reflection = {"", "--reflection"};
    CHECK(holds(read(whole(), request).text, "--reflection: error: no reflection plugin is called ''"));
}

TEST_CASE("a value in place of a table is reported once, without its missing keys") {
    check_error("version = 1\nobserver = 3\n", 2, 1, "expected the table [observer]");
    check_error("version = 1\n[[observer]]\nposition = [0, 0, 1]\n", 2, 3, "there may be only one");
    check_error("version = 1\nshading = 3\n" + k_observer, 2, 1, "expected the table [shading]");
}

TEST_CASE("an ill-defined view is an error") {
    check_error("version = 1\n[observer]\nposition = [1, 1, 1]\nlook_at = [1, 1, 1]\n", 4, 11, "must differ");
    check_error("version = 1\n[observer]\nposition = [0, 3, 0]\nlook_at = [0, 0, 0]\n", 4, 11, "'up'");
    check_error("version = 1\n[observer]\nposition = [0, 0, 3]\nlook_at = [0, 0, 0]\nup = [0, 0, 2]\n", 5, 6,
                "'up'");
    check_error("version = 1\n[observer]\nposition = [0, 0, 3]\nlook_at = [0, 0, 0]\nup = [0, 0, 0]\n", 5, 6,
                "cannot be zero");
}

TEST_CASE("all problems are reported in one go, sorted by position") {
    const Result result = read(whole() + "size = -1\ncolor = 3\nfoo = 1\n[[light]]\ntype = \"laser\"\n");
    INFO(result.text);
    REQUIRE(result.found.size() == 4);
    for (std::size_t i = 1; i < result.found.size(); ++i)
        CHECK(result.found[i - 1].place.line <= result.found[i].place.line);
}

TEST_CASE("TOML's own errors have a position") {
    check_error("version = 1\n[observer\n", 2, 10, "");
    check_error("version = 1\nversion = 2\n", 2, 11, "'version' is given twice");
}

TEST_CASE("several files are one scene; duplicates of what may occur once are reported with both positions") {
    const auto directory = scratch_directory();
    const auto lights = write_file(directory / "lights.toml", k_light);
    const auto objects = write_file(directory / "objects.toml", "version = 1\n" + k_cube);
    const auto rest = write_file(directory / "rest.toml", k_start + k_models);
    candela::SceneRequest request;
    request.files = {lights, objects, rest};
    const Result result = read(request);
    INFO(result.text);
    REQUIRE(result.scene);
    CHECK(result.scene->lights.size() == 1);
    CHECK(result.scene->objects.size() == 1);

    request.files.push_back(write_file(directory / "again.toml", k_observer));
    const Result twice = read(request);
    CHECK_FALSE(twice.scene);
    CHECK(holds(twice.text, "rest.toml:2:2"));
    request.files.back() = rest;
    CHECK(holds(read(request).text, "is read twice"));
}

TEST_CASE("include adds other files, relative to the file that names them, and detects cycles") {
    const auto directory = scratch_directory();
    write_file(directory / "parts" / "lights.toml", k_light);
    write_file(directory / "loop.toml", "include = [\"loop.toml\"]\nversion = 1\n");
    candela::SceneRequest request;
    request.files = {write_file(directory / "scene.toml", "include = [\"parts/lights.toml\"]\nversion = 1\n" +
                                                              k_observer + k_models + k_cube)};
    CHECK(read(request).scene->lights.size() == 1);
    request.files = {directory / "loop.toml"};
    CHECK(holds(read(request).text, "includes itself"));
    request.files = {write_file(directory / "missing.toml", "include = [\"gone.toml\"]\nversion = 1\n")};
    const Result missing = read(request);
    REQUIRE(missing.found.size() == 1);
    CHECK(missing.found[0].place.line == 1);
    CHECK(missing.found[0].place.column == 12);
}

TEST_CASE("files that cannot be read each have their own message (R11)") {
    const auto directory = scratch_directory();
    const auto message = [&](const std::filesystem::path& file) {
        candela::SceneRequest request;
        request.files = {file};
        const Result result = read(request);
        CHECK_FALSE(result.scene);
        REQUIRE(result.found.size() == 1);
        return result.found[0].message;
    };
    CHECK(holds(message(directory / "gone.toml"), "no such file"));
    CHECK(holds(message(directory), "directory"));
    CHECK(holds(message(write_file(directory / "empty.toml", "")), "empty"));
    CHECK(holds(message(write_file(directory / "binary.toml", std::string("a\0b", 3))), "binary"));
    CHECK(holds(message("/dev/null"), "not a regular file"));
    CHECK(holds(message(write_file(directory / "latin.toml", "version = \"\xe9\"\n")), "UTF-8"));
}

TEST_CASE("settings take precedence over files, by name and by number") {
    candela::SceneRequest request;
    request.settings = {{"--width", "image.width", "77"},
                        {"--set a", "object.box.size", "2.5"},
                        {"--set b", "object.0.material.kd", "[0.1,0.2,0.3]"},
                        {"--set c", "light.0.intensity", "3"},
                        {"--set d", "shading.model", "flat"},
                        {"--set e", "object.\"box\".color", "[1, 2, 3]"}};
    const Result result = read(whole(), request);
    INFO(result.text);
    REQUIRE(result.scene);
    CHECK(result.scene->image.width == 77);
    CHECK(std::get<double>(result.scene->objects[0].shape.parameters.get("size")) == 2.5);
    CHECK(std::get<Vec3>(result.scene->objects[0].reflection.parameters.get("kd")) == Vec3{0.1f, 0.2f, 0.3f});
    CHECK(std::get<double>(result.scene->lights[0].model.parameters.get("intensity")) == 3);
    CHECK(result.scene->objects[0].shading.name == "flat");
    CHECK(result.scene->objects[0].color == Vec3{1, 2, 3});
}

TEST_CASE("invalid settings are errors that name their flag") {
    const auto message = [&](const std::string& path, const std::string& value) {
        candela::SceneRequest request;
        request.settings = {{"--set " + path, path, value}};
        const Result result = read(whole(), request);
        CHECK_FALSE(result.scene);
        INFO(result.text);
        REQUIRE_FALSE(result.found.empty());
        CHECK(result.found[0].place.file == "--set " + path);
        return result.found[0].message + " " + result.found[0].hint;
    };
    CHECK(holds(message("object.bix.size", "2"), "did you mean 'box'?"));
    CHECK(holds(message("object.3.size", "2"), "numbered 0 to 0"));
    CHECK(holds(message("object.box.sise", "2"), "did you mean 'size'?"));
    CHECK(holds(message("object.box.size", "[1"), "not a value"));
    CHECK(holds(message("object.box.size", "big"), "expected a number"));
    CHECK(holds(message("image.width", "0"), "1 to 65536"));
    CHECK(holds(message("image", "0"), "needs a table and a key"));
    CHECK(holds(message("image..width", "0"), "empty part"));
    CHECK(holds(message("object.box.size", "1\nkey = 2"), "not one value"));
}

TEST_CASE("R13: if no model is named, the user is asked, once for both") {
    const std::string scene = k_start + k_light + k_cube;
    int asked = 0;
    candela::SceneRequest request;
    request.ask = [&](const std::string& question) {
        ++asked;
        CHECK(holds(question, "phong shading and phong reflection"));
        return true;
    };
    const Result yes = read(scene, request);
    CHECK(asked == 1);
    REQUIRE(yes.scene);
    CHECK(yes.scene->objects[0].shading.name == "phong");
    CHECK(yes.scene->objects[0].reflection.name == "phong");

    request.ask = [](const std::string&) { return false; };
    CHECK_FALSE(read(scene, request).scene);
    request.ask = nullptr;
    CHECK(holds(read(scene, request).text, "--defaults"));
    request.use_defaults = true;
    CHECK(read(scene, request).scene);
    // If a model is named, or nothing needs shading, nobody is asked.
    request = {};
    request.shading = {"flat"};
    request.reflection = {"lambert"};
    CHECK(read(scene, request).scene);
    CHECK(read(k_start, {}).scene);
}

TEST_CASE("a material for another model is an error, unless the model came from the command line") {
    const std::string scene = whole() + "[object.material]\nkd = 0.3\nshininess = 20\n";
    candela::SceneRequest request;
    request.reflection = {"lambert"};
    const Result overridden = read(scene, request);
    INFO(overridden.text);
    REQUIRE(overridden.scene);
    CHECK(overridden.found.empty());
    CHECK(overridden.scene->objects[0].reflection.name == "lambert");
    CHECK(std::get<Vec3>(overridden.scene->objects[0].reflection.parameters.get("kd")) ==
          Vec3{0.3f, 0.3f, 0.3f});
    check_error(whole() + "reflection = \"lambert\"\n[object.material]\nshininess = 20\n", 17, 1,
                "reflection/phong");
    // A key that no model knows is still a mistake.
    CHECK_FALSE(read(whole() + "[object.material]\nshinyness = 20\n", request).scene);
}

TEST_CASE("a scene without lights or objects is a scene, with a warning") {
    const Result dark = read(k_start + k_models + k_cube);
    CHECK(dark.scene);
    CHECK(holds(dark.text, "no lights"));
    const Result empty = read(k_start);
    CHECK(empty.scene);
    CHECK(holds(empty.text, "no objects"));
}

TEST_CASE("names of lights and objects are unique within their kind") {
    const Result result = read(
        whole() +
        "[[object]]\nname = \"box\"\ntype = \"sphere\"\n[[light]]\nname = \"box\"\ntype = \"ambient\"\n");
    REQUIRE(result.found.size() == 1);
    CHECK(result.found[0].place.line == 16);
    CHECK(holds(result.found[0].message, "another object is called 'box'"));
}

TEST_CASE("a picture narrower than its observer's frame shows as much at the sides as the frame") {
    candela::Observer observer;
    observer.fov = 35;
    observer.height = 3;
    observer.frame_aspect = 1.5f;
    const auto half_width = [](const candela::Observer& o, double aspect) {
        return aspect * std::tan(static_cast<double>(o.fov) * std::numbers::pi / 360);
    };
    const candela::Observer wide = candela::fitted(observer, 300, 200),
                            wider = candela::fitted(observer, 900, 200);
    CHECK(wide.fov == 35);
    CHECK(wide.height == 3);
    CHECK(wider.fov == 35);
    const candela::Observer square = candela::fitted(observer, 200, 200),
                            tall = candela::fitted(observer, 1, 65536);
    CHECK(square.height == 4.5f);
    CHECK(half_width(square, 1) == Catch::Approx(half_width(observer, 1.5)));
    CHECK(tall.fov < 180);
    INFO("fitting twice is the same as fitting once");
    CHECK(candela::fitted(square, 100, 200) == square);
    observer.frame_aspect = 0;
    CHECK(candela::fitted(observer, 100, 200) == observer);
}
