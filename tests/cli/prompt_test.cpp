// Questions and progress: the command and a user at a real (pseudo-)terminal.
#include <fmt/format.h>

#include <catch2/catch_test_macros.hpp>
#include <csignal>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "support/command.h"
#include "support/expect.h"
#include "support/scene_tables.h"
#include "support/text.h"

namespace fs = std::filesystem;

namespace {

constexpr const char* k_both =
    "The scene names no shading or reflection model. Use phong shading and phong reflection? [Y/n] ";
constexpr const char* k_shading = "The scene names no shading model. Use phong shading? [Y/n] ";
constexpr const char* k_reflection = "The scene names no reflection model. Use phong reflection? [Y/n] ";

constexpr const char* k_box = "[[object]]\ntype = \"cube\"\nposition = [0, 1, 0]\n";
constexpr const char* k_ball = "[[object]]\ntype = \"sphere\"\nposition = [0, -1, 0]\n";

/// A scene without models except those in `more`.
std::string scene(const std::string& more) { return k_start + image_table(16, 16) + k_light + more; }

/// A scene in a file, and a name for its picture.
struct Files {
    explicit Files(const std::string& text)
        : directory(scratch_directory()), scene_file(write_file(directory / "scene.toml", text).string()) {}

    std::vector<std::string> render(const std::vector<std::string>& more = {}) const {
        return joined({"render", scene_file, "-o", image().string()}, more);
    }
    fs::path image() const { return directory / "a.png"; }
    /// Removes the picture; returns whether it existed.
    bool take_image() const { return fs::remove(image()); }

    fs::path directory;
    std::string scene_file;
};

}  // namespace

TEST_CASE("R13: without anybody to ask, the error names --defaults, which means yes") {
    const Files files(scene(k_box));
    const CommandResult nobody = expect(run_candela(files.render(), {.input = "y\n"}), 3,
                                        {"the scene names no shading or reflection model", "--defaults"});
    CHECK_FALSE(holds(nobody.err, "[Y/n]"));
    CHECK_FALSE(files.take_image());
    expect(run_candela(files.render({"--defaults"})), 0);
    CHECK(files.take_image());
}

TEST_CASE(
    "R13: on a terminal, the question says what is missing and what will be used; each answer is "
    "understood") {
    const Files files(scene(k_box));
    for (const char* const yes : {"\n", "y\n", "Y\n", "yes\n", "Yes\n", " y \n"}) {
        INFO("answer " << yes);
        const CommandResult result = talk_to_candela(files.render(), {{k_both, yes}});
        CHECK(result.exit_code == 0);
        CHECK(count_of(result.out, "[Y/n]") == 1);
        CHECK(files.take_image());
    }
    for (const char* const no : {"n\n", "N\n", "no\n", "NO\n"}) {
        INFO("answer " << no);
        expect_out(talk_to_candela(files.render(), {{k_both, no}}), 3,
                   {"--shading and --reflection name others"});
        CHECK_FALSE(files.take_image());
    }
}

TEST_CASE("R13: the question is repeated after an invalid answer") {
    const Files files(scene(k_box));
    const std::string again = std::string("Please answer y or n. ") + k_both;
    expect(talk_to_candela(files.render(), {{k_both, "perhaps\n"}, {again, "yn\n"}, {again, "y\n"}}), 0);
    CHECK(files.take_image());
    CHECK(talk_to_candela(files.render(), {{k_both, "perhaps\n"}, {again, "n\n"}}).exit_code == 3);
    CHECK_FALSE(files.take_image());
}

TEST_CASE("R13: Ctrl-D means no, and Ctrl-C ends the command; neither makes a picture") {
    const Files files(scene(k_box));
    expect_out(talk_to_candela(files.render(), {{k_both, "\x04"}}), 3, {"--defaults"});
    CHECK_FALSE(files.take_image());
    CHECK(talk_to_candela(files.render(), {{k_both, "\x03"}}).exit_code == 128 + SIGINT);
    CHECK_FALSE(files.take_image());
    CHECK(std::distance(fs::directory_iterator(files.directory), {}) == 1);
}

TEST_CASE("R13: one question, however many objects need an answer") {
    const Files files(
        scene(std::string(k_box) + k_ball + "[[object]]\ntype = \"torus\"\nposition = [2, 0, 0]\n"));
    const CommandResult result = talk_to_candela(files.render(), {{k_both, "\n"}});
    CHECK(result.exit_code == 0);
    CHECK(count_of(result.out, "[Y/n]") == 1);
}

TEST_CASE("R13: only the missing models are asked for") {
    const auto ask = [](const Files& files, const std::vector<std::string>& flags, const char* question) {
        const CommandResult result = expect(talk_to_candela(files.render(flags), {{question, "\n"}}), 0);
        CHECK(count_of(result.out, "[Y/n]") == 1);
        CHECK(files.take_image());
    };
    const Files neither(scene(k_box));
    ask(neither, {"--shading", "flat"}, k_reflection);
    ask(neither, {"--reflection", "lambert"}, k_shading);
    ask(Files(scene(std::string("[shading]\nmodel = \"flat\"\n") + k_box)), {}, k_reflection);
    ask(Files(scene(std::string("[reflection]\nmodel = \"lambert\"\n") + k_box)), {}, k_shading);
    ask(Files(scene(std::string(k_box) + "shading = \"flat\"\n")), {}, k_reflection);
    // One object without a model is enough.
    ask(Files(scene(std::string(k_box) + "shading = \"flat\"\nreflection = \"lambert\"\n" + k_ball)), {},
        k_both);
}

TEST_CASE("R13: there is no question if nothing is missing or the answer is known") {
    const std::string named = "shading = \"flat\"\nreflection = \"lambert\"\n";
    const auto silent = [](const Files& files, const std::vector<std::string>& flags) {
        const CommandResult result = expect(talk_to_candela(files.render(flags), {}), 0);
        CHECK_FALSE(holds(result.out, "[Y/n]"));
        CHECK(files.take_image());
    };
    silent(Files(scene(k_box + named + k_ball + named)), {});
    silent(Files(scene(k_box)), {"--defaults"});
    silent(Files(scene(k_box)), {"--shading", "flat", "--reflection", "lambert"});
    silent(Files(scene("")), {});  // no objects
}

TEST_CASE("R13: a question needs terminals on stdin and stderr, but not on stdout") {
    const Files files(scene(k_box));
    for (const OnTerminal streams : {OnTerminal{.in = true, .out = true, .err = false},
                                     OnTerminal{.in = false, .out = true, .err = true}}) {
        INFO("stdin a terminal: " << streams.in);
        const CommandResult result = talk_to_candela(files.render(), {}, {.input = "y\n"}, streams);
        CHECK(result.exit_code == 3);
        CHECK(holds(result.out + result.err, "--defaults"));
        CHECK_FALSE(holds(result.out + result.err, "[Y/n]"));
    }
    expect_out(talk_to_candela({"render", files.scene_file, "-o", "-"}, {{k_both, "y\n"}}, {},
                               {.in = true, .out = false, .err = true}),
               0, {"\x89PNG"});
}

TEST_CASE("R13: check never waits, and reports what is missing wherever it runs") {
    const Files files(scene(k_box));
    for (const CommandResult& result :
         {talk_to_candela({"check", files.scene_file}, {}), run_candela({"check", files.scene_file})}) {
        CHECK(result.exit_code == 3);
        CHECK(holds(result.out + result.err, "--defaults"));
        CHECK_FALSE(holds(result.out + result.err, "[Y/n]"));
    }
    CHECK(talk_to_candela({"check", files.scene_file, "--defaults"}, {}).exit_code == 0);
}

TEST_CASE("R13: there is no question about an invalid scene") {
    const Files files(scene(std::string("[room]\nheight = -1\n") + k_box));
    const CommandResult result = talk_to_candela(files.render(), {});
    CHECK(result.exit_code == 3);
    CHECK_FALSE(holds(result.out, "[Y/n]"));
    // If nobody can answer, that is one more error.
    const std::string all = run_candela(files.render()).err;
    CHECK(holds(all, "greater than 0"));
    CHECK(holds(all, "--defaults"));
}

TEST_CASE("with NO_COLOR, neither a question nor the messages after it have colour") {
    const Files files(scene(k_box));
    const CommandSetup plain{.environment = {{"TERM", "xterm"}, {"NO_COLOR", "1"}}};
    const CommandResult result = talk_to_candela(files.render(), {{k_both, "n\n"}}, plain);
    CHECK(result.exit_code == 3);
    CHECK_FALSE(holds(result.out, "\x1b["));
}

TEST_CASE("a long render shows its progress only on a terminal", "[whole]") {
    std::string text = scene(k_models + "[[object]]\ntype = \"sphere\"\n");
    for (int i = 0; i < 500; ++i) {
        text += fmt::format("[[light]]\ntype = \"point\"\nposition = [{}, 4, {}]\n", -4 + 0.016 * i,
                            4 - 0.008 * i);
    }
    const Files files(text);
    const std::vector<std::string> words =
        files.render({"--set", "observer.fov=16", "--width", "1400", "--height", "1400", "--threads", "1"});
    const CommandSetup slow{.environment = {{"CANDELA_INSTRUCTION_SET", "baseline"}}};
    const CommandResult seen = expect_out(talk_to_candela(words, {}, slow), 0, {"\rrendering [", " %"});
    // The bar is erased before the last line.
    CHECK(holds(seen.out, "\r\x1b[K" + files.image().string() + ": 1400 x 1400"));
    const CommandResult unseen = run_candela(words, slow);
    CHECK(unseen.exit_code == 0);
    CHECK_FALSE(holds(unseen.err, "rendering ["));
    CHECK(unseen.out.empty());
}

TEST_CASE("a long check shows its progress only on a terminal", "[whole]") {
    std::string text = scene("[room]\nwidth = 40\nheight = 30\ndepth = 30\n" + k_models);
    // Rods side by side, whose boxes overlap those of thousands of others.
    for (int i = 0; i < 6000; ++i)
        text += fmt::format(
            "[[object]]\ntype = \"cube\"\nscale = [10, 0.0002, 0.0002]\nrotation = [0, 0, 45]\nposition = "
            "[{}, 0, -8]\n",
            0.002 * i - 6);
    const Files files(text);
    const std::vector<std::string> words{"check", files.scene_file};
    const CommandSetup slow{.environment = {{"CANDELA_INSTRUCTION_SET", "baseline"}}};
    const CommandResult seen = talk_to_candela(words, {}, slow);
    INFO(seen.out.substr(0, 1000));
    CHECK(seen.exit_code == 0);
    CHECK(holds(seen.out, "\rreading ["));
    // The bar is erased before the diagnostics.
    CHECK(seen.out.rfind("\r\x1b[K") > seen.out.rfind("\rreading ["));
    CHECK(seen.out.find("The scene is valid.") > seen.out.rfind("\r\x1b[K"));
    CHECK_FALSE(holds(run_candela(words, slow).err, "reading ["));
    CHECK_FALSE(holds(talk_to_candela({"check", files.scene_file, "--quiet"}, {}, slow).out, "reading ["));
}

TEST_CASE("a short render shows no progress") {
    const Files files(scene(k_box));
    CHECK_FALSE(holds(talk_to_candela(files.render({"--defaults"}), {}).out, "rendering ["));
}
