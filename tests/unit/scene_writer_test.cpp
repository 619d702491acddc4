#include <catch2/catch_test_macros.hpp>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "console/diagnostics_text.h"
#include "support/command.h"
#include "support/plugins.h"
#include "support/random_scene.h"
#include "support/scene_tables.h"
#include "support/text.h"

namespace fs = std::filesystem;

using candela::Scene;
using candela::Vec3;

namespace {

/// Reads a scene that must have no errors.
Scene read(const fs::path& file, candela::Registry& registry = test_registry()) {
    candela::Diagnostics diagnostics;
    candela::SceneRequest request;
    if (!file.empty()) request.files = {file};
    auto scene = candela::read_scene(request, registry, diagnostics);
    INFO(diagnostics_text(diagnostics, false, 1000));
    REQUIRE(scene);
    return *std::move(scene);
}

/// A new file of that name: some file systems take milliseconds to rewrite an old one.
fs::path new_file(const fs::path& file, const std::string& text) {
    fs::remove(file);
    return write_file(file, text);
}

/// The scene after it has been written and read; checks that writing it again yields the same bytes.
Scene written_and_read(const Scene& scene, const fs::path& directory,
                       candela::Registry& registry = test_registry()) {
    const std::string text = candela::scene_text(scene);
    Scene again = read(new_file(directory / "written.toml", text), registry);
    INFO(text);
    REQUIRE(candela::scene_text(again) == text);
    return again;
}

std::string refusal(const Scene& scene) {
    return message_of<candela::Error>([&] { candela::scene_text(scene); });
}

}  // namespace

TEST_CASE("a scene is written as people write it, with all omitted defaults") {
    const fs::path file = write_file(scratch_directory() / "scene.toml", R"(version = 1
[observer]
look_at = [0, 0, 0]
position = [0, 1.5, 0.1e1]
[shading]
model = "phong"
[[light]]
type = "ambient"
name = "a \"sky\""
[[object]]
type = "sphere"
position = [1, 0, 0]
scale = [2, 2, 2]
reflection = "lambert"
)");
    CHECK(candela::scene_text(read(file)) == R"(version = 1

[room]
height = 10.0
width  = 10.0
depth  = 10.0

[observer]
position   = [0.0, 1.5, 1.0]
look_at    = [0.0, 0.0, 0.0]
up         = [0.0, 1.0, 0.0]
projection = "perspective"
fov        = 40.0

[image]
width            = 512
height           = 512
samples          = 1
background       = [0, 0, 0]
color_management = "srgb"

[constraints]
overlap = "error"

[shading]
model = "phong"

[reflection]
model = "lambert"

[[light]]
name      = "a \"sky\""
type      = "ambient"
color     = [255, 255, 255]
intensity = 1.0

[[object]]
type     = "sphere"
radius   = 0.5
segments = 64
position = [1.0, 0.0, 0.0]
rotation = [0.0, 0.0, 0.0]
scale    = 2.0
color    = [200, 200, 200]
encloses = false
[object.material]
ka = 0.1
kd = 0.7
)");
}

TEST_CASE("the default scene and the examples are unchanged after they have been written and read") {
    const fs::path directory = scratch_directory();
    const Scene standard = read({});
    CHECK((written_and_read(standard, directory) == standard));
    int examples = 0;
    for (const auto& entry : fs::directory_iterator(fs::path(CANDELA_TEST_SOURCE) / "docs/examples")) {
        if (entry.path().extension() != ".toml") continue;
        const Scene scene = read(entry.path());
        CHECK((written_and_read(scene, directory) == scene));
        ++examples;
    }
    CHECK(examples > 0);
}

TEST_CASE("1000 random scenes are valid, and unchanged after they have been written and read") {
    const fs::path directory = scratch_directory();
    std::size_t lights = 0, objects = 0;
    std::set<std::string> plugins;
    for (unsigned seed = 0; seed < 1000; ++seed) {
        const std::string text = random_scene(seed).text();
        INFO("seed " << seed << "\n" << text);
        const Scene scene = read(new_file(directory / "scene.toml", text));
        REQUIRE((written_and_read(scene, directory) == scene));
        lights += scene.lights.size();
        objects += scene.objects.size();
        for (const candela::LightSource& light : scene.lights) plugins.insert("light/" + light.model.name);
        for (const candela::Object& object : scene.objects) {
            plugins.insert({"shape/" + object.shape.name, "shading/" + object.shading.name,
                            "reflection/" + object.reflection.name});
        }
    }
    CHECK(lights > 1500);
    CHECK(objects > 2000);
    for (const candela::PluginFile* const plugin : test_registry().list()) {
        const std::string id = plugin->manifest.id();
        const candela::PluginKind kind = plugin->manifest.kind;
        if (kind == candela::PluginKind::image || kind == candela::PluginKind::target || id == "shape/mesh")
            continue;
        INFO(id);
        CHECK(plugins.contains(id));
    }
}

TEST_CASE("scenes that differ in one value are different") {
    const Scene scene = read(fs::path(CANDELA_TEST_SOURCE) / "docs/examples/still-life.toml");
    const std::vector<std::function<void(Scene&)>> changes = {
        [](Scene& s) { s.room.height = 7; },
        [](Scene& s) { s.room.width = 7; },
        [](Scene& s) { s.room.depth = 7; },
        [](Scene& s) { s.observer.position.x += 1; },
        [](Scene& s) { s.observer.look_at.y += 1; },
        [](Scene& s) { s.observer.up = {0, 0, 1}; },
        [](Scene& s) { s.observer.projection = candela::Projection::orthographic; },
        [](Scene& s) { s.observer.fov += 1; },
        [](Scene& s) { s.observer.height += 1; },
        [](Scene& s) { s.observer.frame_aspect = 1.5f; },
        [](Scene& s) { s.observer.exposure = 12; },
        [](Scene& s) { s.image.tone = candela::ToneCurve::agx; },
        [](Scene& s) { s.image.width += 1; },
        [](Scene& s) { s.image.height += 1; },
        [](Scene& s) { s.image.samples = 4; },
        [](Scene& s) { s.image.background.z += 1; },
        [](Scene& s) { s.image.color_management = candela::ColorEncoding::none; },
        [](Scene& s) { s.constraints.overlap = candela::Overlap::warn; },
        [](Scene& s) { s.constraints.overlap = candela::Overlap::allow; },
        [](Scene& s) { s.lights.pop_back(); },
        [](Scene& s) { s.lights[1].label.name = "moon light"; },
        [](Scene& s) { s.lights[1].model.parameters.set("intensity", 3.0); },
        [](Scene& s) { s.objects.pop_back(); },
        [](Scene& s) { s.objects[1].label.name = "pot"; },
        [](Scene& s) { s.objects[1].shape.parameters.set("segments", std::int64_t{9}); },
        [](Scene& s) { s.objects[1].transform.position.x += 1; },
        [](Scene& s) { s.objects[1].transform.rotation.x += 1; },
        [](Scene& s) { s.objects[1].transform.scale.x += 1; },
        [](Scene& s) { s.objects[1].color.x += 1; },
        [](Scene& s) { s.objects[1].encloses = true; },
        [](Scene& s) {
            s.objects[1].color = {255, 255, 255};
            s.objects[1].color_texture = {
                .parameter = "color",
                .file = std::string(CANDELA_TEST_SOURCE) + "/LICENSE",
                .placing = {.transform = {.rotation = 45}, .wrap = candela::TextureWrap::clamp}};
        },
        [](Scene& s) {
            s.objects[1].textures.push_back(
                {.parameter = "kd",
                 .file = std::string(CANDELA_TEST_SOURCE) + "/LICENSE",
                 .channel = candela::TextureChannel::green,
                 .scale = {0.5f, 0.25f, 1},
                 .offset = {0.125f, 0, 0},
                 .encoding = candela::TextureEncoding::srgb,
                 .placing = {.uv = 1,
                             .transform = {.scale = {2, -1}, .rotation = 30, .offset = {0, 0.5f}},
                             .wrap = candela::TextureWrap::mirror,
                             .wrap_v = candela::TextureWrapV::clamp}});
            s.objects[1].reflection.parameters.set("kd", Vec3{0.625f, 0.25f, 1});
        },
        [](Scene& s) {
            s.objects[1].textures.push_back({.parameter = "kd",
                                             .attribute = "tint \"1\"",
                                             .channel = candela::TextureChannel::alpha,
                                             .scale = {0.5f, 0.25f, 1}});
            s.objects[1].reflection.parameters.set("kd", Vec3{0.5f, 0.25f, 1});
        },
        [](Scene& s) { s.objects[1].common.emission = {10, 200, 30}; },
        [](Scene& s) { s.objects[1].common.emission_strength = 12.5f; },
        [](Scene& s) { s.objects[1].common.occlusion = 0.25f; },
        [](Scene& s) { s.objects[1].common.opacity = 0.25f; },
        [](Scene& s) { s.objects[1].common.opacity_cutoff = 0.25f; },
        [](Scene& s) {
            const std::string file = std::string(CANDELA_TEST_SOURCE) + "/LICENSE";
            s.objects[1].common.textures = {
                {.parameter = "emission", .file = file, .scale = {0.5f, 0.25f, 1}},
                {.parameter = "occlusion",
                 .file = file,
                 .channel = candela::TextureChannel::green,
                 .scale = {0.5f, 0.5f, 0.5f},
                 .offset = {0.25f, 0.25f, 0.25f}},
                {.parameter = "opacity", .file = file, .channel = candela::TextureChannel::alpha}};
            s.objects[1].common.occlusion = 0.75f;
        },
        [](Scene& s) {
            s.objects[1].common.textures = {
                {.parameter = "opacity",
                 .file = std::string(CANDELA_TEST_SOURCE) + "/LICENSE",
                 .channel = candela::TextureChannel::alpha},
                {.parameter = "opacity", .attribute = "color", .scale = {0.5f, 0.5f, 0.5f}}};
            s.objects[1].common.opacity = 0.5f;
        },
        [](Scene& s) { s.objects[1].shading.name = "flat"; },
        [](Scene& s) { s.objects[1].reflection.parameters.set("kd", Vec3{0.1f, 0.2f, 0.3f}); },
    };
    const fs::path directory = scratch_directory();
    for (std::size_t i = 0; i < changes.size(); ++i) {
        INFO("change " << i);
        Scene changed = scene;
        changes[i](changed);
        CHECK_FALSE((changed == scene));
        CHECK((written_and_read(changed, directory) == changed));
    }
    Scene moved = scene;
    moved.objects[0].place.line += 1;
    moved.lights[0].place.file = "elsewhere.toml";
    CHECK((moved == scene));
}

TEST_CASE("a mesh file is written as an absolute path, however strange") {
    const fs::path directory = scratch_directory();
    write_file(directory / "mé \"sh\"\\\n.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const Scene scene = read(write_file(directory / "scene.toml", k_start + R"([shading]
model = "flat"
[reflection]
model = "phong"
[[object]]
type = "mesh"
file = "../a_mesh_file_is_written_as_an_absolute_path__however_strange/mé \"sh\"\\\n.obj"
)"));
    fs::create_directory(directory / "elsewhere");
    const Scene again = written_and_read(scene, directory / "elsewhere");
    CHECK((again == scene));
    const auto file = std::get<std::string>(again.objects[0].shape.parameters.get("file"));
    CHECK(fs::path(file).is_absolute());
    CHECK(fs::exists(file));
}

TEST_CASE("parameters of a shading model are written in [shading], the only place for them in a file") {
    const fs::path directory = scratch_directory();
    candela::Manifest wavy = test_registry().require(candela::PluginKind::shading, "phong").manifest;
    wavy.name = "wavy";
    wavy.parameters = {{.name = "waves", .type = candela::ParamType::real, .default_value = 2.0}};
    write_file(directory / "shading-wavy.json", candela::to_json(wavy));
    // Never loaded, but it is a library.
    fs::copy_file(fs::path(CANDELA_TEST_PLUGINS) / "shading-phong.so", directory / "shading-wavy.so");
    candela::Registry registry({directory, CANDELA_TEST_PLUGINS});
    const Scene scene = read(write_file(directory / "scene.toml", k_start + R"([shading]
model = "wavy"
waves = 5
[reflection]
model = "phong"
[[object]]
type = "cube"
shading = "phong"
[[object]]
type = "sphere"
shading = "wavy"
[[object]]
type = "torus"
)"),
                             registry);
    CHECK(std::get<double>(scene.objects[1].shading.parameters.get("waves")) == 2);
    CHECK(std::get<double>(scene.objects[2].shading.parameters.get("waves")) == 5);
    CHECK((written_and_read(scene, directory, registry) == scene));

    Scene beyond_words = scene;
    beyond_words.objects[1].shading.parameters.set("waves", 6.0);
    CHECK(holds(refusal(beyond_words),
                "objects number 1 and number 2 have shading models with different parameters"));
}

TEST_CASE("what the format cannot express is refused, not changed") {
    const Scene scene = read({});
    CHECK(refusal(scene).empty());
    Scene other = scene;
    other.objects[0].color = {0.5f, 0, 0};
    CHECK(holds(refusal(other), "0.5 in a colour is not an integer"));
    other = scene;
    other.objects[0].label = {.name = "", .number = 7};
    CHECK(holds(refusal(other), "number 7 has the index 0 and no name"));
    other = scene;
    other.lights[0].label.name =
        "l\xe9"
        "on";
    CHECK(holds(refusal(other), "is not UTF-8"));
    other = scene;
    other.room.height = std::numeric_limits<float>::infinity();
    CHECK_FALSE(refusal(other).empty());
    other = scene;
    other.lights[0].model.parameters = candela::ParamSet(scene.lights[0].model.parameters.schema());
    CHECK(holds(refusal(other), "'lamp': 'position' has no value"));
}

TEST_CASE(
    "a matrix is written row by row, a list number by number, each in the fewest digits that identify it") {
    Scene scene = read({});
    std::vector<candela::Parameter> schema{
        {.name = "mixing",
         .type = candela::ParamType::matrix,
         .default_value = candela::Matrix{0.1f, 2, 3, 4, 5, 6, 7, 8, 9.5f}},
        {.name = "ramp", .type = candela::ParamType::numbers, .default_value = std::vector<float>{0.1f, 2}}};
    for (candela::Object& object : scene.objects) object.reflection.parameters = candela::ParamSet(schema);
    const std::string text = candela::scene_text(scene);
    INFO(text);
    CHECK(holds(text, "mixing = [[0.1, 2.0, 3.0], [4.0, 5.0, 6.0], [7.0, 8.0, 9.5]]\n"));
    CHECK(holds(text, "ramp   = [0.1, 2.0]\n"));
}
