// candela bench: consistent figures, and the usual errors.
#include <catch2/catch_test_macros.hpp>
#include <nlohmann/json.hpp>
#include <string>

#include "support/command.h"
#include "support/expect.h"
#include "support/folder.h"

TEST_CASE("bench: the figures are positive and consistent") {
    const CommandResult result = succeeded(run_candela(
        {"bench", "--frames", "3", "--warm-up", "1", "--width", "160", "--height", "120", "--json"}));
    const auto f = nlohmann::json::parse(result.out);
    CHECK(f.at("width") == 160);
    CHECK(f.at("height") == 120);
    CHECK(f.at("frames") == 3);
    CHECK(f.at("triangles") == 12);
    for (const char* const key : {"read_ms", "meshes_ms", "tiles_ms", "frame_ms", "relit_frame_ms"}) {
        INFO(key);
        CHECK(f.at(key).get<double>() > 0);
    }
    CHECK(f.at("fastest_frame_ms").get<double>() <= f.at("frame_ms").get<double>());
    const double pixels = f.at("mpixels_per_second").get<double>() * f.at("frame_ms").get<double>() * 1e3;
    CHECK(pixels > 0.99 * 160 * 120);
    CHECK(pixels < 1.01 * 160 * 120);
}

TEST_CASE("bench: prints a table and leaves no file behind") {
    const Folder directory;
    expect_out(directory.run("bench --frames 2 --width 64 --height 64"), 0, {"frame", "Mpixel/s"});
    CHECK(std::filesystem::is_empty(directory));
}

TEST_CASE("bench: invalid numbers are usage errors, and invalid scenes are scene errors") {
    expect(run_candela({"bench", "--frames", "0"}), 2);
    expect(run_candela({"bench", "--threads", "-1"}), 2);
    expect(run_candela({"bench", "--set", "light.lamp.intensity=-1"}), 3);
    expect(run_candela({"bench", "no-such-scene.toml"}), 1);
}
