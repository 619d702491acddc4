// A scene in several files, and files that cannot be read.
#include <catch2/catch_test_macros.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include <sys/stat.h>
#include <unistd.h>

#include "support/command.h"
#include "support/expect.h"
#include "support/folder.h"
#include "support/scene_tables.h"
#include "support/text.h"

namespace fs = std::filesystem;

namespace {

const std::string k_scene = k_start + k_models + k_light + k_cube;

/// `candela check` of files named as written, in the test's directory.
CommandResult check(const std::vector<std::string>& files, const Folder& directory) {
    return directory.run("check", files);
}

}  // namespace

TEST_CASE("several files form one scene, in any order, on the command line and by include") {
    const Folder d;
    d.write("a.toml", k_start + k_models);
    d.write("b.toml", "version = 1\n" + k_light);
    d.write("c.toml", k_cube);
    CHECK(holds(check({"a.toml", "b.toml", "c.toml"}, d).out, "1 (1 point)"));
    CHECK(check({"c.toml", "b.toml", "a.toml"}, d).exit_code == 0);
    d.write("deep/more.toml", "include = [\"../c.toml\"]\n" + k_light);
    d.write("all.toml", "version = 1\ninclude = [\"a.toml\", \"deep/more.toml\"]\n");
    expect_out(check({"all.toml"}, d), 0, {"'box'"});
}

TEST_CASE("a repeated unique table is an error that names both places") {
    const Folder d({{"a.toml", k_scene + "[image]\nwidth = 8\n[room]\nwidth = 9\n"}});
    const auto with = [&](const std::string& text) {
        d.write("b.toml", text);
        return check({"a.toml", "b.toml"}, d);
    };
    expect(with(k_observer), 3, {"b.toml:1:2: error: 'observer' is given twice; first at a.toml:2:2"});
    expect(with("\n[room]\nheight = 3\n"), 3,
           {"b.toml:2:2: error: 'room' is given twice; first at a.toml:17:2"});
    expect(with("[image]\nheight = 3\n"), 3,
           {"b.toml:1:2: error: 'image' is given twice; first at a.toml:15:2"});
    expect(with("[shading]\nmodel = \"flat\"\n"), 3,
           {"b.toml:1:2: error: 'shading' is given twice; first at a.toml:5:2"});
    expect(with("[reflection]\nmodel = \"flat\"\n"), 3, {"'reflection' is given twice; first at a.toml:7:2"});
    expect(with("version = 2\n"), 3, {"b.toml:1:1: error: 'version' is given twice; first at a.toml:1:1"});
    expect(with("version = 1\n" + k_cube), 3,
           {"b.toml:3:8: error: another object is called 'box', at a.toml:"});
    CHECK(with("version = 1\n").exit_code == 0);
}

TEST_CASE("mistakes are shown file by file, in reading order") {
    const Folder d;
    d.write("z.toml", k_scene + "[image]\nwidth = 0\n");
    d.write("a.toml", "[room]\nwidth = 0\n");
    const CommandResult result = check({"z.toml", "a.toml"}, d);
    expect(result, 3, {"z.toml:16:9: error", "a.toml:2:9: error"});
    CHECK(result.err.find("z.toml:16:9") < result.err.find("a.toml:2:9"));
}

TEST_CASE("includes that are circular, missing or repeated are errors at their line") {
    const Folder d;
    const auto included = [&](const std::string& list) {
        d.write("scene.toml", "version = 1\ninclude = " + list + "\n" + k_scene.substr(12));
        return check({"scene.toml"}, d);
    };
    expect(included("[\"scene.toml\"]"), 3, {"scene.toml:2:12: error: 'scene.toml' includes itself"});
    d.write("b.toml", "\ninclude = [\"./scene.toml\"]\n");
    expect(included("[\"b.toml\"]"), 3, {"b.toml:2:12: error: './scene.toml' includes itself"});
    d.write("c.toml", "[room]\n");
    expect(included("[\"lihgts.toml\", \"c.toml\"]"), 3,
           {"scene.toml:2:12: error: there is no file 'lihgts.toml' to include"});
    d.write("lights.toml", k_light);
    expect(included("[\"lihgts.toml\"]"), 3, {"did you mean 'lights.toml'?"});
    expect(included("[\"c.toml\", \"./c.toml\"]"), 3, {"scene.toml:2:22: error: './c.toml' is read twice"});
    expect(included("\"c.toml\""), 3,
           {"scene.toml:2:11: error: 'include' is a string, \"c.toml\"; expected a list of paths"});
    expect(included("[3]"), 3,
           {"scene.toml:2:12: error: 'include' contains the integer 3; expected a quoted path"});
    expect(included("[\".\"]"), 1, {"directory"});
    d.write("broken.toml", "[room\n");
    expect(included("[\"broken.toml\"]"), 3, {"broken.toml:1:6: error"});
    CHECK(included("[]").exit_code == 0);
    expect(check({"c.toml", "c.toml"}, d), 3, {"'c.toml' is read twice"});
}

TEST_CASE("R11: each kind of unreadable file has its own message and exit code") {
    const Folder d({{"scene.toml", k_scene}});
    expect(check({"scnee.toml"}, d), 1,
           {"scnee.toml: error: there is no such file", "did you mean 'scene.toml'?"});
    expect(check({"folder/scene.toml"}, d), 1,
           {"there is no such file", "there is no folder 'folder' either"});
    expect(check({""}, d), 2, {"a scene's file name is empty"});
    fs::create_directory(d / "folder");
    expect(check({"folder"}, d), 1, {"folder: error: this is a directory; expected a scene file"});
    d.write("empty.toml", "");
    expect(check({"empty.toml"}, d), 3, {"empty.toml:1:1: error: the file is empty"});
    d.write("blank.toml", " \n\t\n");
    expect(check({"blank.toml"}, d), 3, {"blank.toml:1:1: error: the file is empty"});
    d.write("picture.png", std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16));
    expect(check({"picture.png"}, d), 3,
           {"picture.png:3:1: error: this is a binary file; a scene is text (TOML)"});
    d.write("latin1.toml", k_scene + "# caf\xe9\n");
    expect(check({"latin1.toml"}, d), 3,
           {"latin1.toml:15:6: error: this is not UTF-8 text", "save the file as UTF-8", "# caf\\x{e9}"});
    REQUIRE(::mkfifo((d / "fifo").c_str(), 0600) == 0);
    expect(check({"fifo"}, d), 1, {"fifo: error: this is not a regular file (a pipe or a device?)"});
    expect(check({"/dev/zero"}, d), 1, {"/dev/zero: error: this is not a regular file"});
    d.write("huge.toml", "");
    fs::resize_file(d / "huge.toml", 100'000'000);
    expect(check({"huge.toml"}, d), 1,
           {"huge.toml:1:1: error: the file is too large: 100000000 bytes, where a scene may have"});
    fs::create_symlink("gone.toml", d / "link.toml");
    expect(check({"link.toml"}, d), 1, {"link.toml: error: there is no such file"});
    // All files are examined.
    expect(check({"scnee.toml", "empty.toml", "folder"}, d), 3,
           {"scnee.toml: error", "empty.toml:1:1: error", "folder: error"});
}

TEST_CASE("R11: a file without read permission says so") {
    const Folder d;
    const fs::path file = d.write("secret.toml", k_scene);
    fs::permissions(file, fs::perms::none);
    if (::geteuid() != 0) {
        expect(check({"secret.toml"}, d), 1,
               {"secret.toml:1:1: error: the file cannot be opened: Permission denied"});
        return;
    }
    // Root may read everything; the process gives up that right.
    const CommandResult result =
        run_program({"setpriv", "--bounding-set=-dac_override,-dac_read_search", "--inh-caps=-all", "--",
                     CANDELA_TEST_COMMAND, "check", file.string()});
    expect(result, 1, {"secret.toml:1:1: error: the file cannot be opened: Permission denied"});
}

TEST_CASE("R11: mesh files that are broken, empty or without triangles each have their own message") {
    const Folder d;
    const auto mesh = [&](const std::string& name, const std::string& content) {
        d.write(name, content);
        d.write("scene.toml",
                k_scene + "[[object]]\ntype = \"mesh\"\nfile = \"" + name + "\"\nposition = [2, 0, 0]\n");
        const CommandResult result = check({"scene.toml"}, d);
        CHECK(holds(result.err, "scene.toml:15:1: error: object number 1: plugin shape/mesh: '"));
        return result;
    };
    expect(mesh("empty.obj", ""), 1, {"empty.obj"});
    expect(mesh("junk.ply", "junk"), 1, {"junk.ply"});
    expect(mesh("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"), 1, {"points.obj", "no faces"});
    expect(mesh("beyond.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n"), 1, {"beyond.obj", "out of range"});
    expect(mesh("what.xyz", "0 0 0\n"), 1, {"what.xyz"});
}
