// Animated scenes: tracks against splines computed by hand, and problems found in frames.
#include <catch2/catch_approx.hpp>
#include <catch2/catch_test_macros.hpp>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "console/diagnostics_text.h"
#include "render/frame_checks.h"
#include "support/command.h"
#include "support/plugins.h"
#include "support/text.h"

using candela::Interpolation;
using candela::Track;
using candela::Vec3;
using Catch::Approx;

namespace {

Track track(Interpolation interpolation, std::vector<candela::Key> keys,
            candela::ParamType type = candela::ParamType::real) {
    return {.path = "light.lamp.intensity",
            .type = type,
            .keys = std::move(keys),
            .interpolation = interpolation};
}

double number_at(const Track& track, double time) { return std::get<double>(candela::value_at(track, time)); }

constexpr const char* k_scene = R"(version = 1
[observer]
position = [0.0, 1.0, 4.0]
look_at = [0.0, 0.0, 0.0]
[image]
width = 24
height = 16
[shading]
model = "phong"
[reflection]
model = "phong"
[[light]]
name = "lamp"
type = "point"
position = [0.0, 3.0, 0.0]
intensity = 9.0
[[object]]
name = "ball"
type = "sphere"
radius = 0.5
[[object]]
name = "box"
type = "cube"
position = [2.0, 0.0, 0.0]
)";

candela::SceneRequest request_of(const std::string& animation) {
    candela::SceneRequest request;
    request.files = {write_file(scratch_directory() / "scene.toml", k_scene + animation)};
    return request;
}

/// The diagnostics of checking all frames.
std::string found_in(const candela::SceneRequest& request) {
    candela::Diagnostics diagnostics;
    auto frames = candela::SceneFrames::read(request, test_registry(), diagnostics);
    if (frames && frames->animation()) {
        std::vector<int> all(static_cast<std::size_t>(frames->count()));
        std::iota(all.begin(), all.end(), 0);
        candela::check_frames(*frames, all, test_registry(), diagnostics);
    } else if (frames) {
        static_cast<void>(frames->draft(0, diagnostics));
    }
    return diagnostics_text(diagnostics, false, 1000);
}

std::string found_in(const std::string& animation) { return found_in(request_of(animation)); }

candela::SceneFrames frames_of(const std::string& animation) {
    candela::Diagnostics diagnostics;
    auto frames = candela::SceneFrames::read(request_of(animation), test_registry(), diagnostics);
    INFO(diagnostics_text(diagnostics, false));
    REQUIRE(frames);
    REQUIRE(frames->animation());
    return *std::move(frames);
}

candela::Scene scene_in(candela::SceneFrames& frames, int frame) {
    candela::Diagnostics diagnostics;
    return frames.draft(frame, diagnostics).scene;
}

constexpr const char* k_four_frames = "[animation]\nframes = 4\nfps = 1\n";

std::string with_track(const std::string& path, const std::string& keys, const std::string& more = "") {
    return std::string(k_four_frames) + "[[animation.track]]\npath = \"" + path + "\"\nkeys = " + keys +
           "\n" + more + "\n";
}

}  // namespace

TEST_CASE("a track keeps its first value before its first key, and its last after its last") {
    for (const auto way : {Interpolation::step, Interpolation::linear, Interpolation::smooth}) {
        const Track one = track(way, {{1.0, 2.0}, {3.0, 6.0}});
        CHECK(number_at(one, -5) == 2);
        CHECK(number_at(one, 1) == 2);
        CHECK(number_at(one, 3) == 6);
        CHECK(number_at(one, 100) == 6);
    }
}

TEST_CASE("between keys a track stays constant, or is linear") {
    CHECK(number_at(track(Interpolation::step, {{0.0, 2.0}, {2.0, 6.0}}), 1.99) == 2);
    CHECK(number_at(track(Interpolation::linear, {{0.0, 2.0}, {2.0, 6.0}}), 0.5) == 3);
}

TEST_CASE("a smooth track is Catmull and Rom's spline: (-a + 9b + 9c - d) / 16 half-way between b and c") {
    const Track smooth = track(Interpolation::smooth, {{0.0, 1.0}, {1.0, 5.0}, {2.0, -2.0}, {3.0, 8.0}});
    CHECK(number_at(smooth, 1.5) == Approx((-1.0 + 9 * 5 + 9 * -2 - 8) / 16));
    CHECK(number_at(smooth, 1) == 5);
    CHECK(number_at(smooth, 2) == Approx(-2));
}

TEST_CASE("a smooth track through keys on a line is that line, at whatever times they are") {
    const Track smooth = track(Interpolation::smooth, {{0.0, 1.0}, {0.5, 2.0}, {4.0, 9.0}, {5.0, 11.0}});
    for (const double t : {0.1, 0.5, 0.7, 2.5, 4.2, 4.9}) CHECK(number_at(smooth, t) == Approx(1 + 2 * t));
}

TEST_CASE("interpolated colours and integers are rounded") {
    const Track color = track(Interpolation::linear, {{0.0, Vec3{0, 10, 255}}, {1.0, Vec3{255, 11, 0}}},
                              candela::ParamType::color);
    CHECK(std::get<Vec3>(candela::value_at(color, 0.25)) == Vec3{64, 10, 191});
    const Track integer = track(Interpolation::linear, {{0.0, std::int64_t{4}}, {1.0, std::int64_t{7}}},
                                candela::ParamType::integer);
    CHECK(std::get<std::int64_t>(candela::value_at(integer, 0.5)) == 6);
}

TEST_CASE("rotations turn as written, even the long way round") {
    auto frames = frames_of(with_track("object.box.rotation", "[[0, [0, 0, 0]], [3, [0, 540, 0]]]"));
    CHECK(scene_in(frames, 2).objects[1].transform.rotation == Vec3{0, 360, 0});
}

TEST_CASE("an orbit turns the observer counter-clockwise about its look-at point, and ends where it began") {
    auto frames = frames_of(std::string(k_four_frames) + "[animation.orbit]\n");
    CHECK(scene_in(frames, 0).observer.position == Vec3{0, 1, 4});
    const Vec3 quarter = scene_in(frames, 1).observer.position;
    CHECK(quarter.x == Approx(4));
    CHECK(quarter.y == Approx(1));
    CHECK(quarter.z == Approx(0).margin(1e-6));
    const Vec3 half = scene_in(frames, 2).observer.position;
    CHECK(half.x == Approx(0).margin(1e-6));
    CHECK(half.z == Approx(-4));
    auto back = frames_of(std::string(k_four_frames) + "[animation.orbit]\nturns = -1\n");
    CHECK(scene_in(back, 1).observer.position.x == Approx(-4));
}

TEST_CASE("a mistake in the animation is reported at its place") {
    const std::vector<std::pair<std::string, std::string>> mistakes = {
        {"[animation]\n", "has no 'frames'"},
        {"[animation]\nframes = 0\n", "'frames'"},
        {"[animation]\nframes = 4\nfps = 0\n", "'fps'"},
        {"[animation]\nframes = 4\nfsp = 25\n", "did you mean 'fps'?"},
        {"[animation]\nframes = 4\norbit = 3\n", "expected the table [animation.orbit]"},
        {"[animation]\nframes = 4\ntrack = 3\n", "each headed [[animation.track]]"},
        {with_track("light.lmap.intensity", "[[0, 1]]"), "did you mean 'lamp'?"},
        {with_track("light.lamp.intensty", "[[0, 1]]"), "did you mean 'intensity'?"},
        {with_track("light.7.intensity", "[[0, 1]]"), "there is no light 7"},
        {with_track("objct.box.rotation", "[[0, [0, 0, 0]]]"), "did you mean 'object'?"},
        {with_track("object.box.material.shinines", "[[0, 1]]"), "did you mean 'shininess'?"},
        {with_track("object.box.material.kd", "[[0, 1.5]]"), "'kd'"},
        {with_track("image.width", "[[0, 10]]"), "all frames must have the same size"},
        {with_track("animation.frames", "[[0, 10]]"), "cannot be animated"},
        {with_track("fov", "[[0, 10]]"), "the path needs a table and a key"},
        {with_track("light.lamp.intensity", "3"), "expected a list of [time, value]"},
        {with_track("light.lamp.intensity", "[]"), "an empty list"},
        {with_track("light.lamp.intensity", "[1, 2]"), "a key is the integer 1; expected [time, value]"},
        {with_track("light.lamp.intensity", "[[1, 2, 3]]"), "a key has 3 values"},
        {with_track("light.lamp.intensity", "[[\"now\", 2]]"), "'time' is a string"},
        {with_track("light.lamp.intensity", "[[1, \"much\"]]"), "'intensity' is a string"},
        {with_track("light.lamp.intensity", "[[1, 2], [1, 3]]"),
         "the key at 1 s does not come after the one at 1 s"},
        {with_track("light.lamp.intensity", "[[1, -2]]"), "'intensity'"},
        {with_track("light.lamp.intensity", "[[1, 2]]", "interpolation = \"smoth\""),
         "did you mean 'smooth'?"},
        {with_track("light.lamp.intensity", "[[1, 2]]", "speed = 3"), "unknown key 'speed'"},
        {with_track("object.box.type", "[[1, \"cube\"]]"), "cannot be interpolated"},
        {with_track("image.samples", "[[0, 1], [3, 16]]"), "cannot be interpolated"},
        {with_track("light.lamp.intensity", "[[0, 1]]") +
             "[[animation.track]]\npath = \"light.0.intensity\"\nkeys = [[0, 2]]\n",
         "another track changes 'light.lamp.intensity' already"},
        {with_track("observer.position", "[[0, [0, 1, 4]]]") + "[animation.orbit]\n",
         "[animation.orbit] determines the observer's position already"},
    };
    for (const auto& [animation, part] : mistakes) {
        const std::string text = found_in(animation);
        INFO(animation << text);
        CHECK(holds(text, part));
        CHECK(holds(text, "scene.toml:"));
        CHECK(holds(text, "error"));
    }
}

TEST_CASE("a problem that no key has, but some frame, is reported with its frame, its track and its line") {
    // The spline goes below zero between its keys.
    const std::string text = found_in(
        with_track("light.lamp.intensity", "[[0, 9], [2, 0], [4, 0], [5, 9]]", "interpolation = \"smooth\""));
    INFO(text);
    CHECK(holds(text, "in frame 3, by the track of 'light.lamp.intensity'"));
    CHECK(holds(text, "scene.toml:30:"));
    CHECK(holds(text, "'intensity'"));
}

TEST_CASE("objects that collide, leave the room or swallow a light on their way are reported") {
    const std::string meet =
        found_in(with_track("object.box.position", "[[0, [2, 0, 0]], [4, [-1.6, 0, 0]]]"));
    INFO(meet);
    CHECK(holds(meet, "object 'box' overlaps object 'ball'"));
    CHECK(holds(meet, "in frame 2, by the track of 'object.box.position', and in 1 more"));
    const std::string leave = found_in(with_track("object.box.position", "[[0, [2, 0, 0]], [3, [5, 0, 0]]]"));
    INFO(leave);
    CHECK(holds(leave, "object 'box' is not wholly inside the room"));
    CHECK(holds(leave, "in frame 3"));
    const std::string swallow =
        found_in(with_track("light.lamp.position", "[[0, [0, 3, 0]], [3, [0, 0, 0]]]"));
    INFO(swallow);
    CHECK(holds(swallow, "light 'lamp' is inside object 'ball'"));
    CHECK(holds(swallow, "in frame 3, by the track of 'light.lamp.position'"));
    const std::string orbit = found_in(std::string(k_four_frames) +
                                       "[animation.orbit]\n[[object]]\nname = \"post\"\ntype = "
                                       "\"cube\"\nposition = [4, 1, 0]\n");
    INFO(orbit);
    CHECK(holds(orbit, "the observer is inside object 'post'"));
    CHECK(holds(orbit, "in frame 1"));
}

TEST_CASE("a problem of all frames is reported once, without a frame") {
    const std::string text =
        found_in(with_track("light.lamp.intensity", "[[0, 1]]") + "[[object]]\ntype = \"cube\"\n");
    INFO(text);
    CHECK(holds(text, "overlaps object 'ball'"));
    CHECK_FALSE(holds(text, "in frame"));
}

TEST_CASE("a setting overrides a track, with a warning that says so") {
    candela::SceneRequest request = request_of(with_track("light.lamp.intensity", "[[0, 1], [3, 4]]"));
    request.settings = {{"--set light.0.intensity", "light.0.intensity", "7"}};
    candela::Diagnostics diagnostics;
    auto frames = candela::SceneFrames::read(request, test_registry(), diagnostics);
    REQUIRE(frames);
    CHECK(holds(diagnostics_text(diagnostics, false), "--set light.0.intensity overrides it"));
    const candela::Scene scene = scene_in(*frames, 2);
    CHECK(std::get<double>(scene.lights[0].model.parameters.get("intensity")) == 7);
}

TEST_CASE("a nonexistent frame is refused") {
    auto frames = frames_of(std::string(k_four_frames));
    candela::Diagnostics diagnostics;
    CHECK_THROWS_AS(frames.draft(4, diagnostics), candela::Error);
    CHECK_THROWS_AS(frames.draft(-1, diagnostics), candela::Error);
}

TEST_CASE("an animated scene that is written reads back as the same scene in every frame") {
    auto frames = frames_of(with_track("object.box.color", "[[0, [0, 0, 0]], [2, [255, 0, 9]]]") +
                            "[[animation.track]]\npath = \"light.lamp.intensity\"\nkeys = [[0.5, 1], [2, "
                            "3.5]]\ninterpolation = \"smooth\"\n[[animation.track]]\npath = "
                            "\"object.box.encloses\"\nkeys = [[0, false], [1, true]]\ninterpolation = "
                            "\"step\"\n[animation.orbit]\nturns = 0.5\n");
    const candela::Scene first = scene_in(frames, 0);
    candela::SceneRequest request;
    request.files = {write_file(scratch_directory() / "written.toml", candela::scene_text(first))};
    candela::Diagnostics diagnostics;
    auto again = candela::SceneFrames::read(request, test_registry(), diagnostics);
    INFO(diagnostics_text(diagnostics, false));
    REQUIRE(again);
    for (int i = 0; i < 4; ++i) CHECK(scene_in(*again, i) == scene_in(frames, i));
}

TEST_CASE("frames compiled in sequence equal frames compiled alone, and reuse what does not move") {
    auto frames =
        frames_of(with_track("light.lamp.intensity", "[[0, 9], [3, 30]]") +
                  "[[animation.track]]\npath = \"object.box.rotation\"\nkeys = [[1, [0, 0, 0]], [2, "
                  "[0, 45, 0]]]\n[[animation.track]]\npath = \"object.ball.color\"\nkeys = [[2, "
                  "[200, 200, 200]], [3, [9, 200, 9]]]\n");
    candela::FrameBuilder builder(test_registry());
    candela::Renderer renderer(candela::Renderer::Keep::visibility);
    std::vector<bool> kept;
    for (const int number : {0, 1, 2, 3, 0}) {
        candela::Diagnostics diagnostics;
        const candela::SceneDraft draft = frames.draft(number, diagnostics);
        const candela::RenderScene* const scene = builder.build(draft, diagnostics);
        REQUIRE(scene != nullptr);
        kept.push_back(builder.has_kept_triangles());
        if (!kept.back()) renderer.forget();
        const auto alone = candela::build(draft, test_registry(), diagnostics);
        REQUIRE(alone);
        candela::Film a(24, 16, candela::PixelType::byte, candela::ColorEncoding::srgb);
        candela::Film b(24, 16, candela::PixelType::byte, candela::ColorEncoding::srgb);
        renderer.render(*scene, a, {.threads = 1});
        candela::render(*alone, b, {.threads = 1});
        const auto bytes_of = [](const candela::Film& film) {
            const auto bytes = film.view().bytes;
            return std::vector<std::uint8_t>(bytes.begin(), bytes.end());
        };
        CHECK(bytes_of(a) == bytes_of(b));
    }
    CHECK(kept == std::vector<bool>{false, true, false, false, false});
}

TEST_CASE("shadows of scenes built in sequence equal those of scenes built alone, whatever changes") {
    candela::FrameBuilder builder(test_registry());
    candela::Renderer renderer(candela::Renderer::Keep::visibility);
    std::vector<bool> kept;
    std::vector<candela::Setting> settings = {{"--shadows", "shadows.enabled", "true"}};
    using Changes = std::vector<std::pair<std::string, std::string>>;
    for (const auto& [path, value] : Changes{{"observer.position", "[0.0, 1.5, 4.0]"},
                                             {"light.lamp.position", "[0.5, 3.0, 0.5]"},
                                             {"object.box.casts_shadows", "false"},
                                             {"object.box.casts_shadows", "true"},
                                             {"object.ball.receives_shadows", "false"},
                                             {"light.lamp.casts_shadows", "false"},
                                             {"light.lamp.casts_shadows", "true"},
                                             {"object.ball.receives_shadows", "true"},
                                             {"shadows.enabled", "false"},
                                             {"shadows.enabled", "true"},
                                             {"object.box.reflection", "dielectric"},
                                             {"object.box.transmits_light", "false"},
                                             {"object.box.encloses", "true"},
                                             {"object.box.rotation", "[0, 30, 0]"},
                                             {"object.box.color", "[9, 200, 9]"},
                                             {"shadows.pattern", "fixed"}}) {
        settings.push_back({"--set", path, value});
        candela::SceneRequest request = request_of("");
        request.settings = settings;
        candela::Diagnostics diagnostics;
        auto frames = candela::SceneFrames::read(request, test_registry(), diagnostics);
        INFO(path << " = " << value << diagnostics_text(diagnostics, false));
        REQUIRE(frames);
        const candela::SceneDraft draft = frames->draft(0, diagnostics);
        const candela::RenderScene* const scene = builder.build(draft, diagnostics);
        REQUIRE(scene != nullptr);
        kept.push_back(builder.has_kept_triangles());
        if (!kept.back()) renderer.forget();
        const auto alone = candela::build(draft, test_registry(), diagnostics);
        REQUIRE(alone);
        CHECK(scene->occlusion.has_value() ==
              (draft.scene.shadows.enabled && draft.scene.lights[0].casts_shadows));
        candela::Film a(24, 16, candela::PixelType::real, candela::ColorEncoding::srgb);
        candela::Film b(24, 16, candela::PixelType::real, candela::ColorEncoding::srgb);
        renderer.render(*scene, a, {.threads = 1});
        candela::render(*alone, b, {.threads = 1});
        const auto reals_of = [](const candela::Film& film) {
            const auto reals = film.view().reals;
            return std::vector<float>(reals.begin(), reals.end());
        };
        CHECK(reals_of(a) == reals_of(b));
    }
    // From the second on, until the box encloses, turns, or has another colour.
    CHECK(kept == std::vector<bool>{false, true, true, true, true, true, true, true, true, true, true, true,
                                    false, false, false, true});
}
