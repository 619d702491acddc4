// Pictures in parts, and pictures that do not fit into memory.
#include <sys/resource.h>

#include <catch2/catch_test_macros.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/box_scene.h"
#include "support/command.h"
#include "support/expect.h"
#include "support/folder.h"
#include "support/text.h"

namespace fs = std::filesystem;

namespace {

std::string scene_text() {
    return box_scene(201, 200) + R"(rotation = [20, 30, 0]
)";
}

Folder with_scene() { return {{"scene.toml", scene_text()}}; }

void render_part(const Folder& directory, const std::string& image, const std::string& part) {
    succeeded(directory.run_words({"render", "scene.toml", "-o", image, "--part", part}));
}

void check_parts_of(const std::string& extension) {
    const Folder directory = with_scene();
    const std::string image = "poster." + extension, whole = "whole." + extension;
    succeeded(directory.run_words({"render", "scene.toml", "-o", whole}));
    for (const int parts : {1, 3, 7}) {
        INFO(extension << ", " << parts << " parts");
        for (int i = parts; i >= 1; --i)
            render_part(directory, image, std::to_string(i) + "/" + std::to_string(parts));
        succeeded(directory.run_words({"assemble", image}));
        CHECK(directory.read(image) == directory.read(whole));
        CHECK_FALSE(fs::exists(directory / (image + ".parts")));
        fs::remove(directory / image);
    }
}

}  // namespace

TEST_CASE(
    "assembled parts equal the picture rendered in one go, in a format written by rows and in another") {
    check_parts_of("png");
    check_parts_of("jpg");
}

TEST_CASE("assembled parts equal the picture rendered in one go, in every other format", "[whole]") {
    for (const char* const extension : {"tif", "exr", "ppm", "pfm"}) check_parts_of(extension);
}

TEST_CASE("large pictures, which are written in tiles, read back unchanged") {
    const Folder directory = with_scene();
    const std::vector<std::string> size = {"--width", "16384", "--height", "300"};
    for (const std::string extension : {"tif", "png"}) {
        succeeded(directory.run("render scene.toml -o large." + extension, size));
    }
    expect_out(directory.run("diff large.tif large.png"), 0, {"identical           100 %"});
}

TEST_CASE("assemble says which parts are missing and which were made from other inputs") {
    const Folder directory = with_scene();
    for (const char* const part : {"1/6", "2/6", "4/6"}) render_part(directory, "poster.png", part);
    CommandResult result =
        expect(directory.run("assemble poster.png"), 1, {"is incomplete (6 parts); missing: 3, 5-6"});
    CHECK_FALSE(directory.has("poster.png"));

    std::string scene = scene_text();
    scene.replace(scene.find("9.0"), 3, "8.0");
    directory.write("scene.toml", scene);
    for (const char* const part : {"3/6", "5/6", "6/6"}) render_part(directory, "poster.png", part);
    result = directory.run("assemble poster.png");
    CHECK(result.exit_code == 1);
    CHECK(holds(result.err, "made from other inputs than the part rendered last: 1-2, 4"));
    for (const char* const part : {"1/6", "2/6", "4/6"}) render_part(directory, "poster.png", part);
    succeeded(directory.run("assemble poster.png --keep-parts"));
    CHECK(directory.has("poster.png.parts/6-of-6.pixels"));
    succeeded(directory.run("render scene.toml -o whole.png"));
    CHECK(directory.read("poster.png") == directory.read("whole.png"));
}

TEST_CASE("a part that is up to date is kept, a truncated one is not, and repeating is harmless") {
    const Folder directory = with_scene();
    render_part(directory, "poster.tif", "1/2");
    const fs::path file = directory / "poster.tif.parts/1-of-2.pixels";
    const std::string whole = read_file(file);
    CHECK(holds(directory.run("render scene.toml -o poster.tif --part 1/2").err, "already up to date"));
    write_file(file, whole.substr(0, whole.size() / 2));
    render_part(directory, "poster.tif", "1/2");
    CHECK(read_file(file) == whole);
    render_part(directory, "poster.tif", "2/2");
    succeeded(directory.run("assemble poster.tif"));
    expect(directory.run("assemble poster.tif"), 0, {"is already complete"});
    CHECK(holds(directory.run("render scene.toml -o poster.tif --part 2/2").err,
                "the picture is already complete"));
    CHECK_FALSE(directory.has("poster.tif.parts"));
}

TEST_CASE("a part whose bytes have changed is not used, and is rendered again") {
    const Folder directory = with_scene();
    for (const char* const part : {"1/2", "2/2"}) render_part(directory, "poster.tif", part);
    const fs::path file = directory / "poster.tif.parts/2-of-2.pixels";
    const std::string whole = read_file(file);
    std::string changed = whole;
    changed[changed.size() / 2] ^= 1;
    write_file(file, changed);
    const CommandResult result = directory.run("assemble poster.tif");
    CHECK(result.exit_code == 1);
    CHECK(holds(result.err,
                "2-of-2.pixels' has changed since it was rendered; render it again with --part 2/2"));
    CHECK_FALSE(directory.has("poster.tif"));
    render_part(directory, "poster.tif", "2/2");
    CHECK(read_file(file) == whole);
    succeeded(directory.run("assemble poster.tif"));
}

TEST_CASE("a description that has changed since its parts were rendered makes no other picture of them") {
    const Folder directory = with_scene();
    for (const char* const part : {"1/2", "2/2"}) render_part(directory, "poster.tif", part);
    const fs::path description = directory / "poster.tif.parts/picture.json";
    const std::string right = read_file(description);
    const auto width = right.find("\"width\": ") + 9;
    const std::string narrow = right.substr(0, width) + "1" + right.substr(right.find(',', width));
    std::string linear = right;
    linear.replace(linear.find("true"), 4, "false");
    for (const std::string& changed : {narrow, linear}) {
        write_file(description, changed);
        expect(directory.run("assemble poster.tif"), 1,
               {"made from other inputs than the part rendered last: 1-2"});
        CHECK_FALSE(directory.has("poster.tif"));
    }
    write_file(description, right);
    succeeded(directory.run("assemble poster.tif"));
}

TEST_CASE("submit --parts makes the same picture as in one go, and status follows it") {
    const Folder directory = with_scene();
    succeeded(directory.run("submit scene.toml -o poster.tif --parts 5 --jobs 2"));
    succeeded(directory.run("render scene.toml -o whole.tif"));
    CHECK(directory.read("poster.tif") == directory.read("whole.tif"));
    const auto status = nlohmann::json::parse(directory.run("status --json").out).at(0);
    CHECK(status["done"] == 5);
    CHECK(status["last"]["state"] == "done");
    CHECK_FALSE(directory.has("poster.tif.parts"));
    CHECK(holds(directory.run("submit scene.toml -o poster.tif --parts 5").err, "5 of them already done"));
}

TEST_CASE("messages explain mistakes with parts") {
    const Folder directory = with_scene();
    const auto refused = [&](const std::vector<std::string>& words, int code, const std::string& part) {
        expect(directory.run_words(words), code, {part});
    };
    const auto render = [](const Words& more) {
        return joined({"render", "scene.toml", "-o", "p.png"}, more);
    };
    refused(render({"--part", "3"}), 2, "'3'; expected a part such as 3/16");
    refused(render({"--part", "x/2"}), 2, "'x/2'; expected a part");
    refused(render({"--part", "0/2"}), 2, "expected 1/2 to 2/2");
    refused(render({"--part", "3/2"}), 2, "expected 1/2 to 2/2");
    refused(render({"--part", "1/201"}), 2, "a picture of 200 rows cannot be split into 201 parts");
    refused(render({"--part", "1/2", "--terms", "depth"}), 2, "--terms and --part cannot be combined");
    refused(render({"--part", "1/2", "--no-clobber"}), 2, "--no-clobber and --part cannot be combined");
    refused({"render", "scene.toml", "-o", "-", "--part", "1/2"}, 2, "name it with -o");
    refused({"assemble"}, 2, "needs the picture's name");
    refused({"assemble", "p.png"}, 1, "'p.png' has no parts");
    refused({"assemble", "p.what"}, 2, "has a format that no image plugin");
    directory.write("p.png.parts/picture.json", "{\"width\": 3}");
    refused({"assemble", "p.png"}, 1, "does not describe a picture");
    refused({"submit", "scene.toml", "--parts", "4"}, 2, "name it with -o");
    refused({"submit", "scene.toml", "--parts", "4", "-o", "a.png", "--chunk", "3"}, 2,
            "--chunk applies to frames");
    refused({"submit", "scene.toml", "-o", "a%d.png"}, 2, "--parts 16 distributes");
}

// AddressSanitizer and ThreadSanitizer reserve terabytes.
#if !defined(__SANITIZE_ADDRESS__) && !__has_feature(address_sanitizer) && !__has_feature(thread_sanitizer)
TEST_CASE("a part of a picture of 65536 x 65536, and a picture by rows, take less than 1 GiB") {
    const Folder directory = with_scene();
    CommandSetup setup{.directory = directory};
    setup.prepare = [] {
        const rlimit room{.rlim_cur = rlim_t{1} << 30, .rlim_max = rlim_t{1} << 30};
        ::setrlimit(RLIMIT_AS, &room);
    };
    const std::string large = "65536";
    expect(run_candela({"render", "scene.toml", "--width", large, "--height", large, "-o", "poster.tif",
                        "--part", "65/128", "--threads", "2"},
                       setup),
           0);
    CHECK(fs::file_size(directory / "poster.tif.parts/65-of-128.pixels") == 3ull * 65536 * 512);

    // 1.2 GB of pixels.
    expect(run_candela({"render", "scene.toml", "--width", large, "--height", "6000", "-o", "rows.png",
                        "--threads", "2"},
                       setup),
           0);
}
#endif
