// --format-set: parameters of the format of a picture.
#include <catch2/catch_test_macros.hpp>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "support/box_scene.h"
#include "support/command.h"
#include "support/expect.h"
#include "support/folder.h"

namespace fs = std::filesystem;

namespace {

Folder with_scene(const std::string& more = "") { return {{"scene.toml", box_scene(64, 48) + more}}; }

/// The size of a picture that render writes with the arguments `more`.
std::uintmax_t rendered_size(const Folder& directory, const std::string& name,
                             std::vector<std::string> more = {}) {
    more.insert(more.begin(), {"render", "scene.toml", "-o", name});
    succeeded(directory.run_words(more));
    return fs::file_size(directory / name);
}

constexpr const char* k_two_frames = "[animation]\nframes = 2\nfps = 1\n[animation.orbit]\n";

}  // namespace

TEST_CASE(
    "format: --format-set quality: the lower, the smaller the JPEG, and the default is that of describe") {
    const Folder d = with_scene();
    const auto at = [&](const std::string& quality) {
        return rendered_size(d, quality + ".jpg", {"--format-set", "quality=" + quality});
    };
    CHECK(at("10") < at("50"));
    CHECK(at("50") < at("100"));
    CHECK(rendered_size(d, "default.jpg") == at("95"));
}

TEST_CASE("format: --format-set compression=0: a PNG as large as its pixels, with the same pixels") {
    const Folder d = with_scene();
    const std::uintmax_t stored = rendered_size(d, "stored.png", {"--format-set", "compression=0"});
    CHECK(stored > 3 * 64 * 48);
    CHECK(rendered_size(d, "usual.png") < stored);
    expect(d.run("diff stored.png usual.png"), 0);
    // The last of two values counts, also on standard output.
    CHECK(rendered_size(d, "last.png", {"--format-set", "compression=9", "--format-set", "compression=0"}) ==
          stored);
    CHECK(d.run("render scene.toml -o - --format-set compression=0").out.size() == stored);
}

TEST_CASE("format: a wrong --format-set is an error, and no picture is written") {
    const Folder d = with_scene();
    const auto refused = [&](const std::string& setting, const std::vector<std::string>& parts) {
        expect(d.run_words({"render", "scene.toml", "-o", "a.jpg", "--format-set", setting}), 2, parts);
        CHECK_FALSE(d.has("a.jpg"));
    };
    refused("quality=300", {"--format-set quality", "300", "1 to 100"});
    refused("quality=good", {"--format-set quality", "good", "integer"});
    refused("qualty=80", {"--format-set qualty", "image/jpeg", "did you mean 'quality'"});
    refused("compression=3", {"unknown key 'compression' in image/jpeg (candela describe image/jpeg)"});
    refused("quality=[", {"--format-set quality"});
    refused("80", {"--format-set '80' has no value", "--format-set quality=80"});
    refused("=80", {"--format-set '=80' has no value"});
}

TEST_CASE("frames of another --format-set are rendered again, and those of the same are kept") {
    const Folder d = with_scene(k_two_frames);
    const auto animated = [&](const std::string& quality) {
        return d.run_words({"animate", "scene.toml", "-o", "f%d.jpg", "--format-set", "quality=" + quality});
    };
    REQUIRE(animated("90").exit_code == 0);
    const std::uintmax_t fine = fs::file_size(d / "f0.jpg");
    REQUIRE(animated("20").exit_code == 0);
    CHECK(fs::file_size(d / "f0.jpg") < fine);
    const auto written = fs::last_write_time(d / "f0.jpg");
    REQUIRE(animated("20").exit_code == 0);
    CHECK(fs::last_write_time(d / "f0.jpg") == written);
}

TEST_CASE("tasks follow --format-set, for frames and assembled pictures") {
    const Folder d = with_scene(k_two_frames);
    const std::uintmax_t stored = rendered_size(d, "whole.png", {"--format-set", "compression=0"});
    const auto submitted = [&](std::vector<std::string> more) {
        more.insert(more.begin(), {"submit", "scene.toml", "--format-set", "compression=0"});
        succeeded(d.run_words(more));
    };
    submitted({"-o", "frames/%d.png"});
    CHECK(fs::file_size(d / "frames/0.png") == stored);
    submitted({"-o", "parts.png", "--parts", "3"});
    CHECK(fs::file_size(d / "parts.png") == stored);
}

TEST_CASE("a sheet of pictures follows --format-set") {
    const Folder d = with_scene();
    const auto size = [&](const std::string& compression) {
        succeeded(d.run_words({"compare", "scene.toml", "--reflection", "phong,lambert", "-o", "sheet.png",
                               "--format-set", "compression=" + compression}));
        return fs::file_size(d / "sheet.png");
    };
    CHECK(size("9") < size("0"));
}
