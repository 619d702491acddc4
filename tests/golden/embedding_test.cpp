// candela/embedding.h: scenes and pictures within a program.
#include "candela/embedding.h"

#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "support/text.h"

using candela::embedding::ByteImage;
using candela::embedding::FloatImage;
using candela::embedding::Scene;

namespace {

candela::embedding::Options with_plugins() { return {.plugin_folders = {CANDELA_TEST_PLUGINS}}; }

constexpr const char* k_ball = R"(version = 1
image = {width = 64, height = 48, color_management = "none"}
observer = {position = [0, 0, 4], look_at = [0, 0, 0], fov = 40}
shading = {model = "phong"}
reflection = {model = "lambert"}
[[light]]
name = "lamp"
type = "directional"
direction = [0, 0, -1]
intensity = 0.5
[[object]]
name = "ball"
type = "sphere"
color = [255, 255, 255]
)";

Scene ball() { return Scene::from_text(k_ball, "ball.toml", with_plugins()); }

/// The red value at the centre.
template <typename Image>
auto centre_of(const Image& image) {
    return image.rgb[3 * static_cast<std::size_t>(image.height / 2 * image.width + image.width / 2)];
}

std::optional<candela::embedding::Error> error_of(const std::string& text) {
    try {
        Scene::from_text(text, "wrong.toml", with_plugins());
    } catch (const candela::embedding::Error& error) {
        return error;
    }
    return {};
}

}  // namespace

TEST_CASE("embedding: a picture in memory is the core's, in bytes and in floats") {
    Scene scene = ball();
    CHECK(scene.warnings().empty());
    const ByteImage bytes = scene.render();
    const FloatImage floats = scene.render_floats();
    REQUIRE(bytes.width == 64);
    REQUIRE(bytes.height == 48);
    REQUIRE(bytes.rgb.size() == std::size_t{64} * 48 * 3);
    REQUIRE(floats.rgb.size() == bytes.rgb.size());
    for (std::size_t i = 0; i < bytes.rgb.size(); ++i) {
        // Without colour management a byte is the intensity times 255, rounded.
        const float level = std::clamp(floats.rgb[i], 0.0f, 1.0f) * 255;
        REQUIRE(std::abs(level - static_cast<float>(bytes.rgb[i])) <= 0.501f);
    }
}

TEST_CASE("embedding: a setting shows in the next picture, and a wrong value leaves the scene unchanged") {
    Scene scene = ball();
    const float before = centre_of(scene.render_floats());
    CHECK(before > 0.1f);
    scene.set("light.lamp.intensity", "0.25");
    CHECK(std::abs(centre_of(scene.render_floats()) - before / 2) < 1e-6f);
    CHECK_THROWS_AS(scene.set("light.lamp.intensity", "bright"), candela::embedding::Error);
    CHECK_THROWS_AS(scene.set("light.lamb.intensity", "1"), candela::embedding::Error);
    CHECK(std::abs(centre_of(scene.render_floats()) - before / 2) < 1e-6f);
    scene.set("light.lamp.intensity", "0.5");
    scene.set("image.width", "32");
    CHECK(scene.width() == 32);
    CHECK(scene.render().width == 32);
    CHECK(std::abs(centre_of(scene.render_floats()) - before) < 1e-3f);
}

TEST_CASE("embedding: an error lists every problem with its place") {
    std::string text = k_ball;
    text.replace(text.find("intensity = 0.5"), 15, "intensity = -1");
    text.replace(text.find("\"sphere\""), 8, "\"spere\"");
    const auto error = error_of(text);
    REQUIRE(error);
    REQUIRE(error->problems().size() == 2);
    CHECK(error->problems()[0].file == "wrong.toml");
    CHECK(error->problems()[0].line == 10);
    CHECK(error->problems()[0].column == 13);
    CHECK(error->problems()[0].is_error);
    CHECK(std::string(error->what()).starts_with("wrong.toml:10:13: error: "));
    CHECK(holds(std::string(error->what()), "sphere"));
    CHECK_THROWS_AS(Scene({"/there/is/no/such.toml"}, with_plugins()), candela::embedding::Error);
}

TEST_CASE("embedding: the default scene needs no file, and progress is reported to the end") {
    std::size_t last = 0, whole = 0;
    candela::embedding::Options options = with_plugins();
    options.threads = 1;
    options.progress = [&](std::size_t done, std::size_t all) {
        last = std::max(last, done);
        whole = all;
    };
    Scene scene({}, options);
    const ByteImage image = scene.render();
    CHECK(image.width == scene.width());
    CHECK(image.height == scene.height());
    CHECK(whole > 0);
    CHECK(last == whole);
    Scene moved = std::move(scene);
    CHECK(moved.render().rgb == image.rgb);
}
