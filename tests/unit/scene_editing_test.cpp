// Changes written into a scene's files: the file then has the effect that the change had as an override, and
// nothing else is touched.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "console/diagnostics_text.h"
#include "scene_edit/scene_edit.h"
#include "support/command.h"
#include "support/plugins.h"
#include "support/random_scene.h"
#include "support/text.h"

namespace fs = std::filesystem;

namespace {

using Changes = std::vector<std::pair<std::string, std::string>>;

std::vector<candela::Setting> settings_of(const Changes& changes) {
    std::vector<candela::Setting> settings;
    for (const auto& [path, value] : changes) settings.push_back({"--change " + path, path, value});
    return settings;
}

/// The only file that differs.
std::string file_with(const fs::path& file, const Changes& changes) {
    candela::SceneRequest request;
    request.files = {file};
    candela::Diagnostics diagnostics;
    const auto texts = candela::edited_files(request, settings_of(changes), test_registry(), diagnostics);
    INFO(diagnostics_text(diagnostics, false));
    REQUIRE_FALSE(diagnostics.has_errors());
    REQUIRE(texts.size() == 1);
    return texts.front().after;
}

std::string text_with(const std::string& text, const Changes& changes) {
    return file_with(write_file(scratch_directory() / "scene.toml", text), changes);
}

constexpr const char* k_scene = R"(# A lesson's scene.
version = 1

[observer]          # where the class sits
position = [0, 1, 4]
look_at = [0, 0, 0] # the cube
[shading]
model = "phong"
[reflection]
model = "phong"

[[light]]
name = "key"        # the window
type = "point"
position = [
    2,  # to the right
    3,
    2,
]
intensity = 0.5     # on a dull day

[[light]]
type = "ambient"

[[object]]
type = "cube"
color = [200, 90, 40]
material.kd = 0.5   # dull
material.ks = 0.25
)";

}  // namespace

TEST_CASE("a changed value replaces the old one in place, and comments stay") {
    CHECK(text_with(k_scene, {{"light.key.intensity", "2"}}) ==
          replaced(k_scene, "intensity = 0.5     # on", "intensity = 2     # on"));
    CHECK(text_with(k_scene, {{"observer.look_at", "[0,0.5,0]"}}) ==
          replaced(k_scene, "[0, 0, 0] # the cube", "[0, 0.5, 0] # the cube"));
    CHECK(text_with(k_scene, {{"object.0.material.kd", "0.75"}}) ==
          replaced(k_scene, "kd = 0.5", "kd = 0.75"));
    CHECK(text_with(k_scene, {{"shading.model", "flat"}}) ==
          replaced(k_scene, "model = \"phong\"", "model = \"flat\""));
}

TEST_CASE("a value on several lines is replaced as a whole") {
    CHECK(text_with(k_scene, {{"light.0.position", "[1,2,3]"}}) ==
          replaced(k_scene, "[\n    2,  # to the right\n    3,\n    2,\n]", "[1, 2, 3]"));
}

TEST_CASE("a key that a table does not have yet is added after its last line") {
    CHECK(text_with(k_scene, {{"light.1.intensity", "0.25"}}) ==
          replaced(k_scene, "type = \"ambient\"\n", "type = \"ambient\"\nintensity = 0.25\n"));
    CHECK(text_with(k_scene, {{"object.0.material.shininess", "9"}}) ==
          replaced(k_scene, "ks = 0.25\n", "ks = 0.25\nmaterial.shininess = 9\n"));
    CHECK(text_with(k_scene, {{"observer.fov", "35"}}) ==
          replaced(k_scene, "# the cube\n", "# the cube\nfov = 35\n"));
}

TEST_CASE("a missing table is added at the end") {
    CHECK(text_with(k_scene, {{"image.width", "80"}, {"image.height", "60"}}) ==
          std::string(k_scene) + "\n[image]\nwidth = 80\nheight = 60\n");
}

TEST_CASE("of several values for one path the last one is written, whatever the path calls its light") {
    CHECK(text_with(k_scene, {{"light.key.intensity", "2"}, {"light.0.intensity", "3"}}) ==
          replaced(k_scene, "intensity = 0.5", "intensity = 3"));
}

TEST_CASE("inline tables, misleading strings, CR LF and a missing last line break are preserved") {
    const std::string text =
        "version = 1\r\nobserver = {position = [0, 1, 4], look_at = [0, 0, 0]}\r\n"
        "shading = {model = 'phong'}\r\nreflection = {model = \"phong\"}\r\n"
        "[[light]]\r\nname = \"a # \\\" ] }\"\r\ntype = \"ambient\"\r\n[[object]]\r\ntype = \"sphere\"\r\n"
        "material = {}";
    CHECK(text_with(text, {{"observer.fov", "35"}, {"light.0.name", "\"b\""}}) ==
          replaced(replaced(text, "look_at = [0, 0, 0]}", "look_at = [0, 0, 0], fov = 35}"),
                   "\"a # \\\" ] }\"", "\"b\""));
    CHECK(text_with(text, {{"object.0.material.kd", "0.25"}, {"object.0.material.ks", "0.25"}}) ==
          replaced(text, "material = {}", "material = {kd = 0.25, ks = 0.25}"));
    CHECK(text_with(text, {{"object.0.color", "[1,2,3]"}}) == text + "\r\ncolor = [1, 2, 3]");
}

TEST_CASE("a value in an included file is changed there") {
    const fs::path directory = scratch_directory();
    const std::string light = "[[light]]\nname = \"fill\"\ntype = \"ambient\"\n";
    const fs::path included = write_file(directory / "light.toml", light);
    const fs::path file =
        write_file(directory / "scene.toml", std::string("include = [\"light.toml\"]\n") + k_scene);
    candela::SceneRequest request;
    request.files = {file};
    candela::Diagnostics diagnostics;
    const auto texts =
        candela::edited_files(request, settings_of({{"light.fill.intensity", "0.5"}, {"image.width", "64"}}),
                              test_registry(), diagnostics);
    REQUIRE(texts.size() == 2);
    const auto of = [&](const fs::path& path) {
        return *std::ranges::find(texts, fs::canonical(path), &candela::TextChange::file);
    };
    CHECK(of(included).before == light);
    CHECK(of(included).after == light + "intensity = 0.5\n");
    CHECK(of(file).after.ends_with("\n[image]\nwidth = 64\n"));
    // Nothing has been written.
    CHECK(std::ifstream(included).peek() == '[');
}

TEST_CASE("a change to the value that the file already has changes no file") {
    const fs::path file = write_file(scratch_directory() / "scene.toml", k_scene);
    candela::SceneRequest request;
    request.files = {file};
    candela::Diagnostics diagnostics;
    CHECK(candela::edited_files(request, settings_of({{"light.0.intensity", "0.5"}}), test_registry(),
                                diagnostics)
              .empty());
    CHECK_FALSE(diagnostics.has_errors());
}

TEST_CASE("changes that make the scene invalid are reported, and change nothing") {
    const fs::path file = write_file(scratch_directory() / "scene.toml", k_scene);
    candela::SceneRequest request;
    request.files = {file};
    for (const Changes& changes :
         {Changes{{"light.0.intensity", "-1"}}, Changes{{"light.9.intensity", "1"}},
          Changes{{"light.0.intensty", "1"}}, Changes{{"light.0.intensity", "[1"}}}) {
        candela::Diagnostics diagnostics;
        CHECK(candela::edited_files(request, settings_of(changes), test_registry(), diagnostics).empty());
        CHECK(diagnostics.has_errors());
    }
}

TEST_CASE("changes that something else overrides are refused: the file would not show the requested effect") {
    const fs::path file = write_file(scratch_directory() / "scene.toml", k_scene);
    candela::SceneRequest request;
    request.files = {file};
    request.settings = {{"--set", "light.0.intensity", "7"}};
    candela::Diagnostics diagnostics;
    CHECK_THROWS_AS(candela::edited_files(request, settings_of({{"light.0.intensity", "2"}}), test_registry(),
                                          diagnostics),
                    candela::Error);
    CHECK(file_with(file, {{"light.0.intensity", "2"}}) ==
          replaced(k_scene, "intensity = 0.5", "intensity = 2"));
}

TEST_CASE("in any scene, a change in its file has the same effect as an override, and moves no other line") {
    std::mt19937 random(20261123);
    const fs::path directory = scratch_directory();
    int changed = 0;
    for (unsigned seed = 0; seed < 60; ++seed) {
        const RandomScene scene = random_scene(seed);
        const std::string text = scene.text();
        const fs::path file = write_file(directory / fmt::format("{}.toml", seed), text);
        const int number = std::uniform_int_distribution(20, 90)(random);
        candela::SceneRequest request;
        request.files = {file};
        candela::Diagnostics diagnostics;
        Changes wanted{{"image.width", fmt::to_string(number)}};
        if (scene.count("[[object]]") > 0)
            wanted.emplace_back("object.0.color", fmt::format("[{},1,2]", number));
        const std::vector<candela::Setting> changes = settings_of(wanted);
        const auto texts = candela::edited_files(request, changes, test_registry(), diagnostics);
        INFO(diagnostics_text(diagnostics, false) << text);
        REQUIRE(texts.size() == 1);
        ++changed;
        std::istringstream before(text), after(texts.front().after);
        std::vector<std::string> old_lines, new_lines;
        for (std::string line; std::getline(before, line);) old_lines.push_back(line);
        for (std::string line; std::getline(after, line);) new_lines.push_back(line);
        // Every unchanged line is still there, in the same order.
        std::size_t found = 0, kept = 0;
        for (const std::string& line : old_lines) {
            const auto at = std::ranges::find(new_lines.begin() + static_cast<std::ptrdiff_t>(found),
                                              new_lines.end(), line);
            if (at == new_lines.end()) continue;
            found = static_cast<std::size_t>(at - new_lines.begin()) + 1;
            ++kept;
        }
        CHECK(kept + 2 >= old_lines.size());
        CHECK(new_lines.size() <= old_lines.size() + 4);
    }
    CHECK(changed == 60);
}
