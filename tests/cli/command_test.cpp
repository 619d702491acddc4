// The command as used from a shell.
#include <catch2/catch_test_macros.hpp>
#include <filesystem>
#include <string>

#include "support/command.h"
#include "support/expect.h"
#include "support/folder.h"
#include "support/scene_tables.h"
#include "support/text.h"

namespace fs = std::filesystem;

namespace {

std::string scene() { return k_start + image_table(16, 16) + k_light + k_cube + k_models; }

constexpr const char* k_png_signature = "\x89PNG\r\n\x1a\n";

}  // namespace

TEST_CASE("a missing or unknown verb is a usage error with help") {
    const CommandResult none = expect(run_candela({}), 2, {"Verbs"});
    CHECK(none.out.empty());
    expect(run_candela({"redner"}), 2, {"did you mean 'render'?"});
}

TEST_CASE("help and version go to standard output") {
    for (const auto& arguments : {std::vector<std::string>{"--help"}, {"help"}, {"-h"}}) {
        const CommandResult help = expect_out(run_candela(arguments), 0, {"Usage: candela VERB"});
        CHECK(help.err.empty());
    }
    for (const char* const verb : {"new", "render", "check", "diff", "list", "describe", "schema"}) {
        INFO(verb);
        const CommandResult help =
            expect_out(run_candela({verb, "--help"}), 0, {std::string("Usage: candela ") + verb});
        CHECK(run_candela({"help", verb}).out == help.out);
    }
    CHECK(holds(run_candela({"--version"}).out, "candela "));
}

TEST_CASE("unknown options and wrong values are usage errors with suggestions") {
    expect(run_candela({"render", "--relfection", "phong"}), 2, {"did you mean '--reflection'?"});
    expect(run_candela({"render", "--thr", "2"}), 2);
    expect(run_candela({"render", "--threads", "0"}), 2);
    expect(run_candela({"render", "--threads", "many"}), 2);
    expect(run_candela({"render", "--set", "image.width"}), 2);
    expect(run_candela({"list", "lightz"}), 2);
    CHECK(holds(run_candela({"list", "lightz"}).err, "did you mean 'light'?"));
    expect(run_candela({"describe"}), 2);
    expect(run_candela({"check"}), 2);
    expect(run_candela({"list"}, {.environment = {{"CANDELA_INSTRUCTION_SET", "mmx"}}}), 2,
           {"baseline, avx2 or avx512"});
}

TEST_CASE("without arguments, render makes candela.png of the default scene") {
    const Folder directory;
    const CommandResult result = expect(directory.run("render"), 0);
    CHECK(result.out.empty());
    CHECK(holds(result.err, "candela.png: 512 x 512, 12 triangles"));
    CHECK(directory.read("candela.png").starts_with(k_png_signature));
    CHECK(std::distance(fs::directory_iterator(directory), {}) == 1);
}

TEST_CASE("with -o -, render writes a PNG to standard output, and nothing else") {
    const CommandResult result = run_candela({"render", "-o", "-"});
    CHECK(result.exit_code == 0);
    CHECK(result.out.starts_with(k_png_signature));
    CHECK(holds(result.err, "picture: 512 x 512"));
    const fs::path file = scratch_directory() / "a.png";
    run_candela({"render", "-o", file.string()});
    CHECK((read_file(file) == result.out));
}

TEST_CASE("on a terminal, -o - is refused") {
    CHECK(run_candela_on_terminal({"render", "-o", "-"}, "").exit_code == 2);
}

TEST_CASE("flags may precede the scene") {
    const Folder directory;
    const std::string file = directory.write("scene.toml", scene()).string();
    expect(run_candela({"render", file, "-o", (directory / "a.ppm").string(), "--width", "33", "--height",
                        "7", "--samples", "4", "--threads", "2", "--verbose", "--shading", "flat"}),
           0, {"33 x 7", "tiles"});
    CHECK(directory.read("a.ppm").starts_with("P6\n33 7\n255\n"));
}

TEST_CASE("an invalid scene has exit code 3, and no picture is written") {
    const Folder directory;
    const std::string file = directory.write("scene.toml", scene() + "[image2]\n").string();
    const CommandResult result = expect(run_candela({"render", file, "-o", (directory / "a.png").string()}),
                                        3, {file + ":18:2: error: unknown key 'image2' in the scene"});
    CHECK(result.out.empty());
    CHECK_FALSE(directory.has("a.png"));
    expect(run_candela({"check", file}), 3);
    expect(run_candela({"render", (directory / "none.toml").string()}), 1);
}

TEST_CASE("check reports on standard output that a valid scene is valid") {
    const std::string file = write_file(scratch_directory() / "scene.toml", scene()).string();
    const CommandResult result = run_candela({"check", file});
    CHECK(result.exit_code == 0);
    for (const char* const part : {"valid", "16 x 16 pixels", "1 (1 point)", "1, 12 triangles",
                                   "'box'        cube, 12 triangles, phong shading, phong reflection"}) {
        CHECK(holds(result.out, part));
    }
    CHECK(result.err.empty());
}

TEST_CASE("check --print prints the scene as one file that gives the same scene") {
    const Folder directory;
    directory.write("parts/lights.toml", k_light + "name = \"lamp\"\n");
    directory.write("mesh.obj", "v 0 2 0\nv 1 2 0\nv 0 3 0\nf 1 2 3\n");
    const std::string file =
        directory
            .write("scene.toml", "include = [\"parts/lights.toml\"]\n" + k_start + image_table(32, 32) +
                                     "[[object]]\ntype = \"cube\"\n"
                                     "[[object]]\ntype = \"mesh\"\nfile = \"mesh.obj\"\n")
            .string();
    const auto with_more = [&](const Words& words) {
        return run_candela(
            joined(words, {"--defaults", "--set", "light.lamp.intensity=7", "--reflection", "lambert"}));
    };
    const CommandResult printed = succeeded(with_more({"check", file, "--print"}));
    CHECK(printed.out.starts_with("version = 1\n"));
    CHECK_FALSE(holds(printed.out, "include"));
    CHECK(holds(printed.out, "intensity          = 7.0\n"));
    CHECK(holds(printed.out, "[shading]\nmodel = \"phong\"\n\n[reflection]\nmodel = \"lambert\"\n"));
    CHECK(holds(printed.out, "\"" + (directory / "mesh.obj").string() + "\""));

    // From another directory, without any other arguments.
    const std::string copy = write_file(directory / "elsewhere" / "copy.toml", printed.out).string();
    REQUIRE(with_more({"render", file, "-o", (directory / "a.ppm").string()}).exit_code == 0);
    succeeded(run_candela({"render", copy, "-o", (directory / "b.ppm").string()}));
    CHECK((directory.read("a.ppm") == directory.read("b.ppm")));
    CHECK(run_candela({"check", copy, "--print"}).out == printed.out);
    CHECK(run_candela({"check", file, "--print"}).out.empty());  // no model
    expect(run_candela({"check", file, "--print", "--json"}), 2);
}

TEST_CASE("a picture that cannot be written is an error, before and after rendering") {
    const Folder directory;
    expect(run_candela({"render", "-o", (directory / "a.pgn").string()}), 2, {"did you mean '.png'?"});
    expect(run_candela({"render", "-o", (directory / "noextension").string()}), 2);
    expect(run_candela({"render", "-o", (directory / "gone" / "a.png").string()}), 1, {"there is no folder"});
    fs::create_directory(directory / "dir.png");
    CHECK(holds(run_candela({"render", "-o", (directory / "dir.png").string()}).err, "is a directory"));
}

TEST_CASE("a full disk is an error and leaves no partial file") {
    expect(run_candela({"render", "-o", "/dev/full"}), 2);  // no extension
    const Folder directory;
    fs::create_symlink("/dev/full", directory / "full.png");
    const CommandResult full = expect(run_candela({"render", "-o", (directory / "full.png").string()}), 1,
                                      {"No space left on device"});
    expect(run_program({"sh", "-c", std::string(CANDELA_TEST_COMMAND) + " list > /dev/full"}), 1);
}

TEST_CASE(
    "the old picture keeps its place and its permissions until the new one is complete; links stay links") {
    const Folder directory;
    const fs::path file = directory.write("a.png", "old");
    fs::permissions(file, fs::perms::owner_all);
    fs::create_symlink("a.png", directory / "link.png");
    expect(run_candela({"render", "-o", (directory / "link.png").string()}), 0);
    CHECK(fs::is_symlink(directory / "link.png"));
    CHECK(read_file(file).starts_with(k_png_signature));
    CHECK(fs::status(file).permissions() == fs::perms::owner_all);
    CHECK(std::distance(fs::directory_iterator(directory), {}) == 2);
}

TEST_CASE("only terminals get colour, and none with NO_COLOR") {
    CHECK_FALSE(holds(run_candela({"redner"}).err, "\x1b["));
    const CommandSetup colored{.environment = {{"TERM", "xterm"}}};
    CHECK(holds(run_candela_on_terminal({"redner"}, "", colored).out, "\x1b["));
    const CommandSetup plain{.environment = {{"TERM", "xterm"}, {"NO_COLOR", "1"}}};
    CHECK_FALSE(holds(run_candela_on_terminal({"redner"}, "", plain).out, "\x1b["));
}

TEST_CASE("the command itself links neither OpenImageIO nor any other image library") {
    const CommandResult libraries = run_program({"ldd", CANDELA_TEST_COMMAND});
    REQUIRE(libraries.exit_code == 0);
    CHECK(holds(libraries.out, "libcandela_core.so"));
    for (const char* const heavy : {"OpenImageIO", "OpenEXR", "libpng", "libisal"}) {
        CHECK_FALSE(holds(libraries.out, heavy));
    }
}

TEST_CASE("list and describe show the contents of manifests") {
    const CommandResult all = run_candela({"list"});
    CHECK(all.exit_code == 0);
    for (const char* const name : {"half-lambert", "gouraud", "teapot", "spot", "openimageio"})
        CHECK(holds(all.out, name));
    const CommandResult lights = run_candela({"list", "lights"});
    CHECK(holds(lights.out, "spot"));
    CHECK_FALSE(holds(lights.out, "teapot"));
    const CommandResult json = run_candela({"list", "shape", "--json"});
    CHECK(json.out.starts_with("[\n"));
    CHECK(holds(json.out, "\"name\": \"teapot\""));

    const CommandResult phong = run_candela({"describe", "reflection/phong"});
    CHECK(phong.exit_code == 0);
    for (const char* const part : {"k_s I_L max(R.V, 0)^shininess", "Phong (1975)", "shininess", "at least 0",
                                   "default 32", "The Candela authors", "Apache-2.0"}) {
        CHECK(holds(phong.out, part));
    }
    CHECK(holds(run_candela({"describe", "teapot"}).out, "Newell (1975)"));
    expect(run_candela({"describe", "phong"}), 2);
    expect(run_candela({"describe", "reflection/fhong"}), 1, {"did you mean 'phong'?"});
}

TEST_CASE("refused plugins are warnings on standard error, and the others still work") {
    const Folder directory({{"reflection-text.so", "no library"}});
    const CommandResult list = expect(run_candela({"list", "--plugin-dir", directory.path().string()}), 0,
                                      {"reflection-text.so' is refused: its manifest"});
    CHECK(holds(list.out, "blinn-phong"));
    expect(run_candela({"list", "--plugin-dir", (directory / "none").string()}), 1);
}

TEST_CASE("a broken mesh file is an error with the object's place, exit code 1") {
    const Folder directory;
    const auto message = [&](const std::string& name, const std::string& content) {
        directory.write(name, content);
        const std::string file =
            directory
                .write("scene.toml",
                       scene() + "[[object]]\nname = \"thing\"\ntype = \"mesh\"\nfile = \"" + name + "\"\n")
                .string();
        const CommandResult result =
            expect(run_candela({"render", file, "-o", (directory / "a.png").string()}), 1,
                   {"scene.toml:18:1: error: object 'thing': plugin shape/mesh:"});
        CHECK_FALSE(directory.has("a.png"));
        return result.err;
    };
    const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    CHECK(holds(message("beyond.obj", vertices + "f 1 2 9\n"), "out of range"));
    CHECK(holds(message("negative.obj", vertices + "f 1 2 -9\n"), "out of range"));
    CHECK(holds(message("zero.obj", vertices + "f 1 2 0\n"), "index"));
    CHECK(holds(message("nofaces.obj", vertices), "no faces"));
    CHECK(holds(message("nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), "not a finite number"));
    message("junk.obj", "this is not a mesh\n");
    message("empty.obj", "");
    message("junk.glb", "glTF but not quite");
    CHECK(holds(
        message(
            "beyond.ply",
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
            "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 "
            "7\n"),
        "out of range"));
}
