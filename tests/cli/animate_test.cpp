// candela animate: compares frames with those that `render` draws one by one, and checks which are kept.
#include <sys/resource.h>

#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "support/box_scene.h"
#include "support/command.h"
#include "support/expect.h"
#include "support/folder.h"
#include "support/text.h"

namespace fs = std::filesystem;

namespace {

std::string scene_text() {
    return box_scene(33, 21) + R"([animation]
frames = 6
fps = 12
[animation.orbit]
[[animation.track]]
path = "light.lamp.intensity"
keys = [[0.0, 9.0], [0.5, 20.0]]
)";
}

CommandSetup in(const Folder& directory) { return {.directory = directory}; }

Folder with_scene() { return {{"scene.toml", scene_text()}}; }

CommandResult animate(const Folder& directory, const std::vector<std::string>& more = {}) {
    return directory.run("animate scene.toml", more);
}

/// When a file was last written, and its identity in the file system.
auto stamp(const fs::path& file) { return fs::last_write_time(file); }

/// The names in a folder, sorted.
std::vector<std::string> names(const fs::path& folder) {
    std::vector<std::string> result;
    for (const auto& entry : fs::directory_iterator(folder))
        result.push_back(entry.path().filename().string());
    std::ranges::sort(result);
    return result;
}

}  // namespace

TEST_CASE("every frame is the picture that render --frame draws") {
    const Folder directory = with_scene();
    const CommandResult result = animate(directory, {"-o", "frames/%03d.png"});
    INFO(result.err);
    REQUIRE(result.exit_code == 0);
    CHECK(holds(result.err, "6 frames"));
    CHECK(names(directory / "frames") == std::vector<std::string>{".candela", "000.png", "001.png", "002.png",
                                                                  "003.png", "004.png", "005.png"});
    for (int i = 0; i < 6; ++i) {
        succeeded(
            directory.run_words({"render", "scene.toml", "--frame", std::to_string(i), "-o", "one.png"}));
        CHECK(directory.read("one.png") ==
              read_file(directory / "frames" / ("00" + std::to_string(i) + ".png")));
    }
    CHECK(directory.read("frames/000.png") != directory.read("frames/001.png"));
}

TEST_CASE("frames that are complete and made from the same inputs are kept, and others are rendered again") {
    const Folder directory = with_scene();
    REQUIRE(animate(directory, {"--frames", "0..2"}).exit_code == 0);
    const std::string whole = directory.read("frames/0001.png");
    // Truncated, lost, and written by another program.
    directory.write("frames/0001.png", whole.substr(0, whole.size() / 2));
    fs::remove(directory / "frames/0002.png");
    const auto before = stamp(directory / "frames/0000.png");
    CommandResult result = animate(directory, {"--frames", "0..2"});
    CHECK(holds(result.err, "3 frames, 1 of them already up to date"));
    CHECK(stamp(directory / "frames/0000.png") == before);
    CHECK(directory.read("frames/0001.png") == whole);
    CHECK(directory.has("frames/0002.png"));

    // The light gets brighter in frames 1 to 5; frame 0 is unchanged.
    std::string scene = scene_text();
    scene.replace(scene.find("20.0"), 4, "30.0");
    directory.write("scene.toml", scene);
    result = animate(directory, {"--frames", "0..2"});
    CHECK(holds(result.err, "1 of them already up to date"));
    CHECK(directory.read("frames/0001.png") != whole);

    result = animate(directory, {"--frames", "0..2", "--force"});
    CHECK_FALSE(holds(result.err, "already up to date"));
    result = animate(directory, {"--frames", "0..2", "--samples", "4"});
    CHECK_FALSE(holds(result.err, "already up to date"));
}

TEST_CASE("a changed mesh makes animate render its frames again") {
    const Folder directory = with_scene();
    const auto tetrahedron = [](const std::string& height) {
        return "v 0 0 0\nv 1 0 0\nv 0 0 1\nv 0 " + height + " 0\nf 1 2 3\nf 1 4 2\nf 2 4 3\nf 1 3 4\n";
    };
    directory.write("t.obj", tetrahedron("1"));
    directory.write("scene.toml",
                    scene_text() + "[[object]]\ntype = \"mesh\"\nfile = \"t.obj\"\nposition = [1, 1, 0]\n");
    REQUIRE(animate(directory, {"--frames", "3"}).exit_code == 0);
    CHECK(holds(animate(directory, {"--frames", "3"}).err, "1 of them already up to date"));
    directory.write("t.obj", tetrahedron("2"));
    CHECK_FALSE(holds(animate(directory, {"--frames", "3"}).err, "already up to date"));
}

TEST_CASE("frames are chosen by --frames and --step") {
    const Folder directory = with_scene();
    REQUIRE(animate(directory, {"-o", "%d.ppm", "--frames", "1..5", "--step", "3"}).exit_code == 0);
    CHECK(names(directory) == std::vector<std::string>{".candela", "1.ppm", "4.ppm", "scene.toml"});
}

TEST_CASE("two processes that write the same frames at once are harmless") {
    const Folder directory = with_scene();
    RunningProgram one({CANDELA_TEST_COMMAND, "animate", "scene.toml", "--force"}, in(directory));
    RunningProgram other({CANDELA_TEST_COMMAND, "animate", "scene.toml", "--force"}, in(directory));
    CHECK(one.wait().exit_code == 0);
    CHECK(other.wait().exit_code == 0);
    CHECK(names(directory / "frames").size() == 7);
    CHECK(names(directory / "frames/.candela").size() == 6);
    CHECK(holds(animate(directory).err, "6 of them already up to date"));
}

TEST_CASE("messages explain patterns, ranges and scenes that yield no frames") {
    const Folder directory = with_scene();
    directory.write("still.toml", box_scene(33, 21));
    const std::vector<std::pair<std::vector<std::string>, std::string>> mistakes = {
        {{"scene.toml", "-o", "frames/a.png"}, "expected a placeholder for their numbers: frames/a%04d.png"},
        {{"scene.toml", "-o", "%04d-%d.png"}, "more than one placeholder for a frame's number"},
        {{"scene.toml", "-o", "%s.png"},
         "'%s' in '%s.png' is not a placeholder for a frame's number; use %04d"},
        {{"scene.toml", "-o", "%4d.png"}, "not a placeholder for a frame's number"},
        {{"scene.toml", "-o", "%04d/a.png"}, "in a folder name"},
        {{"scene.toml", "-o", "%099d.png"}, "99 digits"},
        {{"scene.toml", "-o", "-"}, "cannot be written to standard output"},
        {{"scene.toml", "-o", "%d.png", "-o", "%d.ppm"}, "-o names frames twice"},
        {{"scene.toml", "-o", "%d.exr", "-o", "a.gif"}, "a film needs 8-bit frames"},
        {{"scene.toml", "-o", "%d.pmg"}, ".pmg"},
        {{"scene.toml", "--frames", "3..9"}, "frame 9 does not exist; the animation has frames 0 to 5"},
        {{"scene.toml", "--frames", "4..2"}, "4 is greater than 2"},
        {{"scene.toml", "--frames", "all"}, "expected a frame or a range"},
        {{"scene.toml", "--frames", "-1"}, "-1"},
        {{"scene.toml", "--step", "0"}, "--step is 0"},
        {{"scene.toml", "--force", "--resume"}, "contradict"},
        {{"still.toml"}, "the scene has no [animation]"},
        {{}, "needs a scene file"},
    };
    for (const auto& [words, part] : mistakes) {
        expect(directory.run("animate", words), 2, {part});
    }
    CHECK(names(directory) == std::vector<std::string>{"scene.toml", "still.toml"});
    expect(directory.run("render scene.toml --frame 6"), 2, {"there is no frame 6"});
}

TEST_CASE("a mistake in a late frame is found before the first is rendered") {
    const Folder directory = with_scene();
    directory.write("scene.toml", scene_text() +
                                      "[[animation.track]]\npath = \"object.box.position\"\nkeys = "
                                      "[[0, [0, 0, 0]], [0.4, [5, 0, 0]]]\n");
    for (const char* const verb : {"animate", "check"}) {
        expect(directory.run_words({verb, "scene.toml"}), 3,
               {"scene.toml:29:", "in frame 5, by the track of 'object.box.position'"});
    }
    CHECK_FALSE(directory.has("frames"));
    // The earlier frames are intact.
    CHECK(animate(directory, {"--frames", "0..3"}).exit_code == 0);
}

TEST_CASE("check sums up the animation") {
    const Folder directory = with_scene();
    const CommandResult text = directory.run("check scene.toml");
    CHECK(holds(text.out,
                "film      6 frames, 12 per second, 0.5 s (the observer's orbit, light.lamp.intensity)"));
    const CommandResult json = directory.run("check scene.toml --json");
    CHECK(holds(json.out, "\"frames\": 6"));
}

TEST_CASE("ffmpeg makes films of all frames, and no other files remain") {
    const Folder directory = with_scene();
    succeeded(animate(directory, {"-o", "film.mp4", "-o", "out/film.gif"}));
    CHECK(names(directory) == std::vector<std::string>{"film.mp4", "out", "scene.toml"});
    CHECK(names(directory / "out") == std::vector<std::string>{"film.gif"});
    CHECK(directory.read("film.mp4").substr(4, 4) == "ftyp");
    CHECK(directory.read("out/film.gif").starts_with("GIF89a"));
    const CommandResult probe =
        run_program({"ffprobe", "-v", "error", "-count_frames", "-show_entries",
                     "stream=width,height,nb_read_frames,r_frame_rate", "-of", "csv=p=0", "film.mp4"},
                    in(directory));
    CHECK(probe.out == "34,22,12/1,6\n");
}

TEST_CASE("a film without ffmpeg is an error that names ffmpeg, before anything is rendered") {
    const Folder directory = with_scene();
    expect(directory.run("animate scene.toml -o film.mp4", {}, {{"PATH", (directory / "nothing").string()}}),
           1, {"apt install ffmpeg"});
    CHECK(names(directory) == std::vector<std::string>{"scene.toml"});
}

TEST_CASE("new --animation writes an animated scene that is valid in all frames") {
    const Folder directory;
    expect(directory.run("new --animation"), 0, {"candela animate scene.toml"});
    const CommandResult check = expect_out(directory.run("check scene.toml"), 0, {"96 frames"});
    CHECK(check.err.empty());
}

namespace {

/// A scene of `count` objects with a track for each, or all tracks for the first.
std::string with_tracks(int count, bool are_all_of_one) {
    std::string text = box_scene(33, 21) + "[constraints]\noverlap = \"allow\"\n[animation]\nframes = 2\n";
    for (int i = 0; i < count; ++i) {
        const std::string name = "part " + std::to_string(i), moved = are_all_of_one ? "part 0" : name;
        text += "[[object]]\ntype = \"cube\"\nsize = 0.01\nname = \"" + name +
                "\"\n[[animation.track]]\npath = 'object.\"" + moved +
                "\".size'\nkeys = [[0.0, 0.01], [1.0, 0.02]]\n";
    }
    return text;
}

CommandResult checked_within(rlim_t seconds, const std::string& scene) {
    const Folder directory({{"scene.toml", scene}});
    CommandSetup setup = in(directory);
    setup.prepare = [seconds] {
        const rlimit time{seconds, seconds};
        ::setrlimit(RLIMIT_CPU, &time);
    };
    return run_candela({"check", "scene.toml"}, setup);
}

}  // namespace

TEST_CASE("thousands of tracks cost as much as thousands of objects, not as their product") {
    constexpr int k_many = 4000;
    expect(checked_within(30, with_tracks(k_many, false)), 0);
}

TEST_CASE("among tracks of one value, each but the first is refused, once") {
    constexpr int k_many = 500;
    expect(checked_within(30, with_tracks(k_many, true)), 3,
           {"another track changes 'object.\"part 0\".size' already",
            "and 449 more (449 of them errors)"});  // 50 are shown
}
