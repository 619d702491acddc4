// Input that nobody writes on purpose, except to do harm, gives an error with a place, in bounded time and
// memory. The inputs are only as large as necessary.
#include <fmt/format.h>

#include <catch2/catch_test_macros.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include <sys/resource.h>
#include <sys/stat.h>

#include "support/command.h"
#include "support/expect.h"
#include "support/folder.h"
#include "support/sanitizers.h"
#include "support/scene_tables.h"
#include "support/text.h"

namespace fs = std::filesystem;

namespace {

const std::string k_head = k_start + k_models;

std::string times(std::size_t count, const std::string& part) {
    std::string result;
    for (std::size_t i = 0; i < count; ++i) result += part;
    return result;
}

CommandResult check(const std::string& text, const std::vector<std::string>& more = {}) {
    const Folder directory({{"a.toml", text}});
    return directory.run("check a.toml", more);
}

/// A limit on the address space; not for sanitizers, which reserve terabytes.
CommandResult in_megabytes(int megabytes, const std::string& arguments) {
    return run_program(
        {"sh", "-c",
         fmt::format("ulimit -v {}; exec " CANDELA_TEST_COMMAND " {}", megabytes * 1000, arguments)});
}

}  // namespace

TEST_CASE("deep nesting is an error at the place where it becomes too deep") {
    constexpr std::size_t k_deep = 200'000;
    const std::string many_parts = times(k_deep, "a.") + "a";
    expect(check("a = " + times(k_deep, "[")), 3, {"a.toml:1:37: error: this is nested more than 32 deep"});
    expect(check("a = " + times(k_deep, "{a=")), 3,
           {"a.toml:1:101: error: this is nested more than 32 deep"});
    expect(check("\n[" + many_parts + "]\n"), 3, {"a.toml:2:65: error: this key has more than 32 parts"});
    expect(check("[[" + many_parts + "]]\n"), 3, {"a.toml:1:66: error: this key has more than 32 parts"});
    expect(check(many_parts + " = 1\n"), 3, {"a.toml:1:64: error: this key has more than 32 parts"});
    expect(check("x = {" + many_parts + " = 1}\n"), 3,
           {"a.toml:1:69: error: this key has more than 32 parts"});
    expect(check("x = {\"a\"" + times(k_deep, " . 'b'") + " = 1}\n"), 3, {"more than 32 parts"});
}

TEST_CASE("brackets and points in strings and comments do not nest, nor do many that are closed") {
    const std::string brackets = times(100, "[") + times(100, "{") + times(100, ".");
    const std::string texts = "[[light]]\ntype = \"ambient\"\nname = ";
    for (const std::string& quoted : {"\"" + brackets + "\\\"" + brackets + "\"", "'" + brackets + "\\'",
                                      "'''" + brackets + "\n''" + brackets + "'''''",
                                      "\"\"\"" + brackets + "\n\\\"\"\"" + brackets + "\"\"\"\""}) {
        expect(check(k_head + texts + quoted + " # " + brackets + "\n"), 0);
    }
    // The error is the earlier unclosed bracket, not the many that follow.
    expect(check(times(40, "[a\n")), 3, {"a.toml:1:3: error: the header's closing ] is missing"});
    expect(check("a = [1, 2\n[b]\n" + times(40, "[")), 3, {"a.toml:2:1: error: expected ',' or ']'"});
}

TEST_CASE("exceeding a scene's limits is an error that states the limit") {
    expect(check(k_head + times(100'001, "[[light]]\n")), 3,
           {"a.toml:100009:1: error: the scene has 100001 lights; it may have at most 100000"});
    expect(check(k_head + times(100'001, "[[object]]\n")), 3, {"100001 objects", "at most 100000"});
    expect(check(k_head + "a = [" + times(5'000'001, "1,") + "]\n"), 3, {"more than 5000000 values"});
}

TEST_CASE("thousands of errors are counted, not all shown") {
    const CommandResult result =
        check(k_head + times(5'000, "[[object]]\ntype = \"cub\"\nsizes = 3\nname = \"same\"\n"));
    expect(result, 3,
           {"a.toml:10:8: error: no shape plugin is called 'cub'; did you mean 'cube'?", "and 9949 more"});
}

TEST_CASE("thousands of keys, at the root and in a table, are read") {
    std::string keys;
    for (int i = 0; i < 20'000; ++i) keys += "k" + std::to_string(i) + " = 1\n";
    expect(check(keys + k_head + "[room]\n" + keys), 3,
           {"a.toml:1:1: error: unknown key 'k0' in the scene", "and 39950 more"});
}

TEST_CASE("a message does not quote megabytes of input") {
    const std::string megabyte(1'000'000, 'x');
    for (const std::string& text :
         {"[[light]]\ntype = \"" + megabyte + "\"\n", megabyte + " = 1\n",
          "[room]\nwidth = \"" + megabyte + "\"\n",
          "[[light]]\nname = \"" + megabyte + "\"\ntype = \"ambient\"\nintensity = -1\n",
          "a = " + megabyte + "\n", "include = [\"" + megabyte + "\"]\n"}) {
        const CommandResult result = check(text + k_head);
        INFO(result.err.substr(0, 3000));
        CHECK(result.exit_code == 3);
        CHECK(result.err.size() < 6000);
    }
}

TEST_CASE("input quoted in a message is not a command to the terminal") {
    const CommandResult result =
        check(k_head +
              "[[light]]\nname = \"\\u001b[2J\"\ntype = \"\\u001b[31m\\u0007\\u009b\"\n"
              "\"\\u001b[A\\nx\" = 1\n");
    CHECK(result.exit_code == 3);
    for (const char* const command : {"\x1b", "\x07", "\xc2\x9b"}) {
        CHECK_FALSE(holds(result.err, command));
    }
    CHECK(holds(result.err, "no light plugin is called '\\u{1b}[31m\\u{7}\\u{9b}'"));
}

TEST_CASE("endless or countless includes are errors") {
    const Folder d;
    for (int i = 0; i < 40; ++i) {
        write_file(d / ("c" + std::to_string(i) + ".toml"),
                   "include = [\"c" + std::to_string(i + 1) + ".toml\"]\n");
    }
    const CommandSetup there{.directory = d};
    expect(run_candela({"check", "c0.toml"}, there), 3,
           {"c32.toml:1:12: error: files include one another more than 32 levels deep"});
    std::string names;
    for (int i = 0; i < 1001; ++i) {
        write_file(d / ("w" + std::to_string(i) + ".toml"), "[[light]]\ntype = \"ambient\"\n");
        names += "\"w" + std::to_string(i) + ".toml\", ";
    }
    d.write("wide.toml", "include = [" + names + "]\n" + k_head);
    expect(run_candela({"check", "wide.toml"}, there), 3, {"the scene consists of more than 1000 files"});
    d.write("same.toml", "include = [" + times(5000, "\"w0.toml\", ") + "]\n" + k_head);
    expect(run_candela({"check", "same.toml"}, there), 3, {"same.toml:1:23: error: 'w0.toml' is read twice"});
}

TEST_CASE("a file of unknown size is read no further than the longest scene") {
    if (!fs::exists("/proc/self/pagemap")) SKIP("there is no such file here");
    expect(run_candela({"check", "/proc/self/pagemap"}), 1,
           {"the file is too large: more than 67108864 bytes"});
}

TEST_CASE("a picture, and a shape, that do not fit into memory are errors that say how much they need") {
    if (k_has_shadow_memory) SKIP("sanitizers need more address space");
    const Folder directory;
    // A format that is not written by rows.
    const std::string output = " -o " + (directory / "a.pfm").string();
    expect(in_megabytes(4000, "render --width 65536 --height 65536" + output), 1,
           {"a picture of 65536 x 65536 pixels needs 51.5 GB of memory; ", " are available"});
    const fs::path scene = directory.write(
        "scene.toml", k_head + "[[object]]\ntype = \"sphere\"\nsegments = 8192\nposition = [2, 0, 0]\n");
    expect(in_megabytes(4000, "render " + scene.string() + output), 1,
           {"scene.toml:9:1: error: object number 0: a shape of 67", " triangles needs ", " GB of memory; "});
    CHECK_FALSE(directory.has("a.pfm"));
}

TEST_CASE("of textures that do not fit into memory, only the first is an error") {
    if (k_has_shadow_memory) SKIP("sanitizers need more address space");
    constexpr std::size_t k_pictures = 60, k_size = 2048;
    const Folder directory(
        {{"0.ppm", fmt::format("P6\n{0} {0}\n255\n", k_size) + std::string(3 * k_size * k_size, 'x')}});
    std::string text = k_head + "[constraints]\noverlap = \"allow\"\n";
    for (std::size_t i = 0; i < k_pictures; ++i) {
        const std::string name = fmt::format("{}.ppm", i);
        if (i > 0) fs::create_hard_link(directory / "0.ppm", directory / name);
        text += fmt::format("[[object]]\ntype = \"sphere\"\ncolor = {{ texture = \"{}\" }}\n", name);
    }
    const fs::path scene = directory.write("scene.toml", text);
    const CommandResult result = in_megabytes(
        1200, fmt::format("render {0} --width 64 --height 48 --threads 2 -o {0}.ppm", scene.string()));
    expect(result, 1, {" MB of memory; ", " are available"});
    CHECK(count_of(result.err, "error:") == 1);
}

TEST_CASE(
    "shadows of ten million triangles take 120 bytes each; with less memory, an error says how much they "
    "need",
    "[whole]") {
    if (k_has_shadow_memory) SKIP("sanitizers need more address space");
    const Folder directory;
    // Four balls of 2.5 million triangles each, above a floor.
    std::string text = k_head +
                       "[shadows]\nenabled = true\n[[light]]\ntype = \"point\"\nposition = [0, 4, 0]\n"
                       "[[object]]\ntype = \"cube\"\nscale = [4, 0.1, 4]\nposition = [0, -1, 0]\n";
    for (const double x : {-1.5, -0.5, 0.5, 1.5})
        text += fmt::format(
            "[[object]]\ntype = \"sphere\"\nradius = 0.4\nsegments = 1584\nposition = [{}, 0, 0]\n", x);
    const fs::path scene = directory.write("scene.toml", text);
    const auto rendered = [&](int megabytes, const std::string& options) {
        return in_megabytes(megabytes,
                            fmt::format("render {} --width 64 --height 48 --threads 2 -o {}/a.ppm {}",
                                        scene.string(), directory.path().string(), options));
    };
    expect(rendered(2300, ""), 0);
    const std::string with = directory.read("a.ppm");
    // 700 MB for the triangles fit, and their tree does not.
    expect(rendered(1600, "--no-shadows"), 0);
    CHECK(with != directory.read("a.ppm"));
    fs::remove(directory / "a.ppm");
    expect(
        rendered(1600, ""), 1,
        {"shadows: the tree of the triangles that cast shadows needs 1.2 GB of memory; ", " are available"});
    CHECK_FALSE(directory.has("a.ppm"));
}

TEST_CASE(
    "a mesh with a corner that is not finite or too far away is an error, also where it would cast shadows") {
    const Folder d;
    d.write("scene.toml", k_head + "[shadows]\nenabled = true\n" + k_light +
                              "[[object]]\ntype = \"mesh\"\nfile = \"a.obj\"\n"
                              "[[object]]\ntype = \"mesh\"\nfile = \"a.ply\"\n");
    const auto with = [&](const std::string& number) {
        d.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 " + number + " 0\nf 1 2 3\n");
        d.write(
            "a.ply",
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
            "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
            "2 0 0\n3 0 0\n2 " +
                number + " 0\n3 0 1 2\n");
        return d.run("render scene.toml -o a.ppm");
    };
    for (const char* const number : {"nan", "-nan", "inf", "-inf"}) {
        INFO(number);
        expect(with(number), 1,
               {"scene.toml:14:1: error: object number 0: ", "a.obj' line 3: ", " is not a finite number",
                "scene.toml:17:1: error: object number 1: ", "a.ply' has a face with the corner [2, ",
                "positions must be finite"});
        CHECK_FALSE(d.has("a.ppm"));
    }
    expect(with("1e39"), 1, {"object number 0: ", "object number 1: ", "non-finite"});
    expect(with("1e38"), 3, {"object number 0: ", "object number 1: ", "is more than 1e+09 m away"});
    expect(with("1"), 0);
}

TEST_CASE("a library that does not fit into the address space causes a message") {
    if (k_has_shadow_memory) SKIP("sanitizers need more address space");
    const Folder directory;
    const auto rendered = [&](rlim_t megabytes, const char* image) {
        CommandSetup setup;
        setup.prepare = [megabytes] {
            const rlimit room{megabytes << 20, megabytes << 20};
            ::setrlimit(RLIMIT_AS, &room);
        };
        return run_candela({"render", "--threads", "1", "-o", (directory / image).string()}, setup);
    };
    CHECK(rendered(150, "a.png").exit_code == 0);
    // OpenImageIO and its 255 libraries take some 400 MB.
    for (const rlim_t megabytes : {rlim_t{100}, rlim_t{200}, rlim_t{300}}) {
        const CommandResult result = rendered(megabytes, "a.exr");
        INFO(megabytes << " MB\n" << result.err);
        if (result.exit_code == 0) continue;
        CHECK(result.exit_code == 1);
        CHECK(holds(result.err, "not enough memory to load it; ulimit -v"));
        CHECK_FALSE(holds(result.err, "build it again"));
    }
}

TEST_CASE("invalid manifests are refused, and the other plugins still work") {
    const Folder d;
    const auto plugin = [&](const std::string& name) {
        d.write(("light-" + name + ".so"), "no library");
        return d / ("light-" + name + ".json");
    };
    write_file(plugin("deep"), times(1'000'000, "["));
    write_file(plugin("objects"), times(100'000, "{\"a\":"));
    write_file(plugin("large"), std::string(2'000'000, ' '));
    write_file(plugin("latin"), "{\"abi\": \"\xe9\"}");
    REQUIRE(::mkfifo(plugin("pipe").c_str(), 0600) == 0);
    const CommandResult result =
        expect_out(run_candela({"list", "light", "--plugin-dir", d.path().string()}), 0, {"point"});
    for (const char* const name : {"deep", "objects", "latin"}) {
        INFO(name);
        CHECK(holds(result.err, std::string("its manifest light-") + name +
                                    ".json cannot be used: it is not a manifest"));
    }
    CHECK(holds(result.err, "light-large.json is larger than 1048576 bytes"));
    CHECK(holds(result.err, "its manifest light-pipe.json is missing"));
}
