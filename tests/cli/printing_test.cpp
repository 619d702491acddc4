// Printing text written by others: manifests, names, paths.
#include <catch2/catch_test_macros.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/command.h"
#include "support/expect.h"
#include "support/scene_tables.h"
#include "support/text.h"

import candela.core;

namespace fs = std::filesystem;

namespace {

const std::string k_hostile = "\x1b]0;x\x07\x1b[2J\xc2\x9b\xe2\x80\xae\x7f";

bool is_printable(const std::string& text) {
    return candela::printable(text, candela::LineBreaks::kept) == text;
}

std::string scene(const std::string& name) {
    return k_start + k_models + k_light + "name = " + name + "\n[[object]]\ntype = \"cube\"\nname = " + name +
           "\n";
}

/// A folder with a shipped plugin whose manifest is changed.
fs::path folder_with_hostile_manifest() {
    const fs::path d = scratch_directory();
    const fs::path shipped = fs::path(CANDELA_TEST_PLUGINS);
    fs::copy_file(shipped / "light-point.so", d / "light-point.so");
    auto manifest = nlohmann::json::parse(read_file(shipped / "light-point.json"));
    for (const char* const key : {"title", "summary", "formula", "reference"})
        manifest[key] = "<" + k_hostile + "\n>";
    manifest["parameters"][0]["meaning"] = k_hostile;
    manifest["properties"]["odd" + k_hostile] = k_hostile;
    write_file(d / "light-point.json", manifest.dump());
    return d;
}

}  // namespace

TEST_CASE("list, describe, schema and doctor print what a manifest says without obeying it") {
    const std::string d = folder_with_hostile_manifest().string();
    for (const std::vector<std::string>& words :
         std::vector<std::vector<std::string>>{{"list"},
                                               {"describe", "light/point"},
                                               {"schema"},
                                               {"schema", "--format", "markdown"},
                                               {"list", "--json"},
                                               {"describe", "--json", "light/point"},
                                               {"plugin", "doctor"}}) {
        std::vector<std::string> all = words;
        all.insert(all.end(), {"--plugin-dir", d});
        const CommandResult result = run_candela(all);
        INFO(words[0] << '\n' << result.out.substr(0, 2000) << result.err);
        CHECK(is_printable(result.out));
        CHECK(is_printable(result.err));
    }
    CHECK(holds(run_candela({"list", "light", "--plugin-dir", d}).out, "<\\u{1b}]0;x\\u{7}"));
    const auto json =
        nlohmann::json::parse(run_candela({"describe", "--json", "light/point", "--plugin-dir", d}).out);
    CHECK(json["summary"] == "<" + k_hostile + "\n>");
    for (const nlohmann::json& plugin :
         nlohmann::json::parse(run_candela({"list", "light", "--json", "--plugin-dir", d}).out))
        CHECK(plugin["kind"] == "light");
}

TEST_CASE("a hostile file name, option, verb or plugin name is shown, not obeyed") {
    for (const std::vector<std::string>& words :
         std::vector<std::vector<std::string>>{{k_hostile},
                                               {"render", "--" + k_hostile},
                                               {"check", k_hostile + ".toml"},
                                               {"list", k_hostile},
                                               {"render", "-o", k_hostile + ".png", k_hostile},
                                               {"describe", k_hostile},
                                               {"describe", "light/" + k_hostile},
                                               {"check", "\xff\xfe.toml"},
                                               {"plugin", "new", "light", k_hostile}}) {
        const CommandResult result = run_candela(words);
        INFO(result.err);
        CHECK(result.exit_code != 0);
        CHECK(is_printable(result.out));
        CHECK(is_printable(result.err));
    }
}

TEST_CASE("check prints characters that hide or reverse text as escapes, also in JSON") {
    const std::string file =
        write_file(scratch_directory() / "scene.toml", scene("\"\\u202eabc\\u001b[31m\"")).string();
    const CommandResult text = expect_out(run_candela({"check", file}), 0, {"'\\u{202e}abc\\u{1b}[31m'"});
    CHECK(is_printable(text.out));
    const CommandResult json = run_candela({"check", "--json", file});
    CHECK(is_printable(json.out));
    CHECK(nlohmann::json::parse(json.out)["scene"]["objects"][0]["label"] ==
          "'\xe2\x80\xae"
          "abc\x1b[31m'");
}

TEST_CASE("check --print keeps names complete, even long ones and those with control characters") {
    const std::string name = "\"" + std::string(300, 'n') + "\\u0001\\u202e\\t\\n'\\\"\xc3\xa9\"";
    const fs::path d = scratch_directory();
    const std::string file = write_file(d / "scene.toml", scene(name)).string();
    const CommandResult printed = succeeded(run_candela({"check", "--print", file}));
    CHECK(is_printable(printed.out));
    const std::string again = write_file(d / "again.toml", printed.out).string();
    CHECK(run_candela({"check", "--print", again}).out == printed.out);
    const auto label = [](const std::string& of) {
        return nlohmann::json::parse(run_candela({"check", "--json", of}).out)["scene"]["lights"][0]["label"];
    };
    CHECK(label(again) == label(file));
    CHECK(label(again) == "'" + std::string(300, 'n') + "\x01\xe2\x80\xae\t\n'\"\xc3\xa9'");
}

TEST_CASE("a message quotes a number as its author wrote it") {
    const fs::path d = scratch_directory();
    const std::string file =
        write_file(d / "scene.toml",
                   scene("\"a\"") + "color = [255.0, 0, 0]\nsize = -1.50\n[image]\nwidth = 1_000_000\n")
            .string();
    const std::string err = run_candela({"check", file}).err;
    INFO(err);
    CHECK(
        holds(err, "'color' is a list whose first value is the number 255.0; expected three integers 0-255"));
    CHECK(holds(err, "-1.50 is outside its range"));
    CHECK(holds(err, "1_000_000 is outside its range: 1 to 65536"));
    CHECK(
        holds(run_candela({"check", file, "--set", "object.0.color=[255.0,0,0]"}).err, "the number 255.0;"));
}

TEST_CASE(
    "everything that is wrong is reported in one go: in a light, an observer, an object and what surrounds "
    "them") {
    const std::string file = write_file(scratch_directory() / "scene.toml", R"(version = 1
[observer]
position = [0, 0, 40]
look_at = "x"
fov = 200
[[light]]
type = "point"
color = [255, 0]
intensity = -1
position = [100, 0, 0]
[[object]]
type = "torus"
color = "red"
positon = [0, 0, 0]
position = [0, 9, 0]
[[object]]
type = "torus"
major_radius = 0.1
minor_radius = 0.2
[shading]
model = "phong"
[reflection]
model = "phong"
)")
                                 .string();
    const CommandResult result = expect(run_candela({"check", file}), 3);
    for (const char* const part :
         {":3:12: error: the observer is not inside the room", ":4:11: error: 'look_at' is a string",
          ":5:7: error: 'fov'", ":8:9: error: 'color'", ":9:13: error: 'intensity'",
          ":10:12: error: light number 0 is not inside the room", ":13:9: error: 'color'",
          ":14:1: error: unknown key 'positon'",
          ":15:12: error: object number 0 is not wholly inside the room", "error: [[object]] number 1"})
        CHECK(holds(result.err, part));
}

TEST_CASE("a file elsewhere that is not part of a scene is never quoted") {
    const fs::path d = scratch_directory();
    const fs::path secret = write_file(d / "elsewhere" / "secret", "root:$y$hash:19000\n");
    const fs::path settings = write_file(d / "elsewhere" / "settings.toml", "password = \"hash\"\n");
    const fs::path lights = write_file(d / "elsewhere" / "lights.toml", "[[light]]\ntype = \"pint\"\n");
    const auto check = [&](const std::string& included) {
        write_file(d / "scene" / "scene.toml", "include = [\"" + included + "\"]\n" + scene("\"a\""));
        return run_candela({"check", (d / "scene" / "scene.toml").string()});
    };
    for (const fs::path& file : {secret, settings, fs::path("../elsewhere/secret")}) {
        const CommandResult result =
            expect(check(file.string()), 3, {"scene.toml:1:12: error: '", "is not part of a scene"});
        CHECK_FALSE(holds(result.err, "hash"));
        CHECK_FALSE(holds(result.err, "password"));
    }
    CHECK(holds(check(secret.string()).err, "it is not TOML at line 1, column 5"));
    // A part of a scene is quoted, wherever it is.
    CHECK(holds(check(lights.string()).err, "type = \"pint\""));
    // And so is every file in the scene's own folder.
    write_file(d / "scene" / "mine.toml", "oops: 1\n");
    CHECK(holds(check("mine.toml").err, "oops: 1"));
}

TEST_CASE("includes, environments and meshes must be regular files, and no command waits for a pipe") {
    const fs::path d = scratch_directory();
    succeeded(run_program({"mkfifo", (d / "pipe").string()}));
    const auto check = [&](const std::string& more) {
        write_file(d / "scene.toml", more);
        return run_candela({"check", (d / "scene.toml").string()});
    };
    for (const char* const file : {"pipe", "/dev/zero", "/dev/null"}) {
        const std::string quoted = std::string("\"") + file + "\"";
        CHECK(holds(check("include = [" + quoted + "]\n" + scene("\"a\"")).err, "not a regular file"));
        CHECK(holds(check(scene("\"a\"") + "[image]\nenvironment = " + quoted + "\n").err,
                    "not a regular file"));
        CHECK(holds(check(scene("\"a\"") + "[[object]]\ntype = \"mesh\"\nfile = " + quoted + "\n").err,
                    "not a regular file"));
    }
}
