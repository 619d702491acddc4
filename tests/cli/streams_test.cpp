// Interaction with a shell: pipes, existing files, narrow terminals, silence.
#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <csignal>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "support/command.h"
#include "support/expect.h"
#include "support/folder.h"
#include "support/scene_tables.h"
#include "support/text.h"

import candela.core;

namespace fs = std::filesystem;

namespace {

const std::string k_scene = k_start + image_table(16, 16) + k_models + k_light;

CommandResult in(const Folder& directory, const std::vector<std::string>& words,
                 const std::string& input = "", const std::string& columns = "") {
    CommandSetup setup{.input = input, .directory = directory};
    if (!columns.empty()) setup.environment.emplace_back("COLUMNS", columns);
    return run_candela(words, setup);
}

std::size_t widest_line(const std::string& text) {
    std::istringstream lines(text);
    std::size_t widest = 0;
    for (std::string line; std::getline(lines, line);)
        widest = std::max(widest, candela::character_count(line));
    return widest;
}

}  // namespace

TEST_CASE("a scene can come from standard input, with paths relative to the current folder") {
    const Folder d({{"cube.toml", "[[object]]\ntype = \"cube\"\n"}});
    const std::string scene = "include = [\"cube.toml\"]\n" + k_scene;
    for (const char* const name : {"-", "/dev/stdin", "/dev/fd/0"}) {
        INFO(name);
        expect_out(in(d, {"check", name}, scene), 0, {"1, 12 triangles"});
        CHECK(in(d, {"render", name, "-o", "a.ppm"}, scene).exit_code == 0);
        CHECK(fs::remove(d / "a.ppm"));
    }
    expect(
        run_program({"sh", "-c", "cat | " CANDELA_TEST_COMMAND " check -"}, {.input = scene, .directory = d}),
        0);
    // A part of the scene is in a file, another comes from the pipe.
    CHECK(holds(in(d, {"check", "cube.toml", "-"}, k_scene).out, "1, 12 triangles"));
}

TEST_CASE("errors in a scene from a pipe have their line") {
    const Folder d;
    expect(in(d, {"check", "-"}, k_scene + "[[object]]\ntype = \"cub\"\n"), 3,
           {"standard input:16:8: error: no shape plugin is called 'cub'", "   16 | type = \"cub\""});
    CHECK(holds(in(d, {"check", "-"}, "").err, "standard input:1:1: error: the file is empty"));
    CHECK(holds(in(d, {"check", "-", "-"}, k_scene).err,
                "standard input: error: 'standard input' is read twice"));
    CHECK(holds(in(d, {"check", "-"}, std::string("a\0", 2)).err,
                "standard input:1:2: error: this is a binary"));
}

TEST_CASE("with --no-clobber, an existing picture stays, and that is an error") {
    const Folder d;
    CHECK(in(d, {"render", "-", "-o", "a.ppm", "--no-clobber"}, k_scene).exit_code == 0);
    d.write("a.ppm", "mine");
    expect(in(d, {"render", "-", "-o", "a.ppm", "--no-clobber"}, k_scene), 1, {"'a.ppm' already exists"});
    CHECK(d.read("a.ppm") == "mine");
    CHECK(in(d, {"render", "-", "-o", "a.ppm"}, k_scene).exit_code == 0);
}

TEST_CASE("a picture never overwrites its inputs, under whatever name") {
    const Folder d;
    const std::string sky = "P6\n1 1\n255\nabc";
    d.write("sky.ppm", sky);
    d.write("part.ppm", "[[light]]\ntype = \"ambient\"\n");
    d.write("mesh.ppm", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    fs::copy_file(d / "mesh.ppm", d / "mesh.obj");
    fs::remove(d / "mesh.ppm");
    fs::create_symlink("mesh.obj", d / "mesh.ppm");
    fs::create_symlink("sky.ppm", d / "link.ppm");
    d.write("scene.ppm", "include = [\"part.ppm\"]\n" + k_start + image_table(16, 16) +
                             "environment = \"sky.ppm\"\n" + k_models +
                             "[[object]]\ntype = \"mesh\"\nfile = \"mesh.obj\"\n");
    for (const char* const name : {"sky.ppm", "./sky.ppm", "link.ppm", "part.ppm", "mesh.ppm", "scene.ppm"}) {
        const std::string before = d.read(name);
        const CommandResult result = in(d, {"render", "scene.ppm", "-o", name});
        INFO(name << ": " << result.err);
        CHECK(result.exit_code == 2);
        CHECK(holds(result.err, "is one of the files that the scene is made from"));
        CHECK(d.read(name) == before);
    }
    CHECK(in(d, {"render", "scene.ppm", "-o", "other.ppm"}).exit_code == 0);
}

TEST_CASE("with --quiet, only errors are printed") {
    const Folder d;
    const CommandResult silent = in(d, {"render", "-", "-o", "a.ppm", "--quiet", "--verbose"}, k_scene);
    CHECK(silent.exit_code == 0);
    CHECK(silent.out + silent.err == "");
    CHECK(in(d, {"check", "-", "-q"}, k_scene).out.empty());
    CHECK(in(d, {"new", "-q"}).err.empty());
    const CommandResult wrong = expect(in(d, {"check", "-", "-q"}, k_scene + "[[object]]\ntype = \"cub\"\n"),
                                       3, {"no shape plugin is called 'cub'"});
    // The scene has no objects, which otherwise causes a warning.
    CHECK(holds(in(d, {"check", "-"}, k_scene).err, "warning"));
    CHECK_FALSE(holds(wrong.err, "warning"));
}

TEST_CASE("a misspelt option is also recognised with its value") {
    expect(run_candela({"render", "--widht=100"}), 2, {"unknown option '--widht'; did you mean '--width'?"});
}

TEST_CASE("list, describe and help fit the width in COLUMNS, or 80 columns") {
    const Folder d;
    for (const std::vector<std::string>& words :
         std::vector<std::vector<std::string>>{{"list"},
                                               {"describe", "light/spot"},
                                               {"--help"},
                                               {"render", "--help"},
                                               {"verify", "--help"},
                                               {"generate", "--help"},
                                               {"new", "--help"}}) {
        std::string first = words[0];
        INFO(first);
        CHECK(widest_line(in(d, words).out) <= 80);
        CHECK(widest_line(in(d, words, "", "132").out) <= 132);
        if (words.back() != "--help") CHECK(widest_line(in(d, words, "", "60").out) <= 75);
    }
    const std::string wide = in(d, {"list"}, "", "200").out;
    CHECK(std::ranges::count(wide, '\n') < std::ranges::count(in(d, {"list"}).out, '\n'));
}

TEST_CASE("describe gives the allowed values, their unit, and whether they are required") {
    const std::string out =
        run_candela({"describe", "light/spot"}, {.environment = {{"COLUMNS", "120"}}}).out;
    INFO(out);
    CHECK(holds(out, "  position             three numbers, a position in metres; required\n"));
    CHECK(holds(out, "  inner_angle          a number, at least 0 and less than 90; default 15 deg\n"));
    CHECK_FALSE(holds(out, "required m"));
}

TEST_CASE("Ctrl-C at a question leaves the shell's prompt a line of its own") {
    const Folder d;
    const std::string file = d.write("scene.toml", k_start + k_cube).string();
    const CommandResult result =
        talk_to_candela({"render", file, "-o", (d / "a.png").string()}, {{"[Y/n] ", "\x03"}});
    CHECK(result.exit_code == 128 + SIGINT);
    CHECK(result.out.ends_with("\n"));
}

TEST_CASE("the thread library prints nothing if there are more threads than cores") {
    const Folder d;
    const CommandResult result = in(d, {"render", "-", "-o", "a.ppm", "--threads", "33", "-q"}, k_scene);
    CHECK(result.exit_code == 0);
    CHECK(result.err.empty());
}

TEST_CASE("an object too far away is an error in the scene") {
    const Folder d;
    expect(in(d, {"check", "-"},
              k_scene + "[[object]]\nname = \"far\"\ntype = \"cube\"\nposition = [0, 2e9, 0]\n" +
                  "[room]\nwidth = 1e10\nheight = 1e10\ndepth = 1e10\n"),
           3, {"standard input:15:1: error: object 'far': vertex 0 at "});
}
