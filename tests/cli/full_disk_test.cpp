// A file that does not fit is an error in every format: nothing of it remains, and the old file stays.
#include <sys/resource.h>
#include <unistd.h>

#include <catch2/catch_test_macros.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "support/command.h"
#include "support/expect.h"
#include "support/folder.h"
#include "support/text.h"

namespace fs = std::filesystem;

namespace {

CommandResult limited(const Folder& directory, const std::vector<std::string>& words, rlim_t most) {
    CommandSetup setup{.directory = directory};
    setup.prepare = [most] {
        const rlimit limit = {most, most};
        if (::setrlimit(RLIMIT_FSIZE, &limit) != 0) ::_exit(125);
    };
    return run_candela(words, setup);
}

/// A file that does not fit leaves the folder unchanged; one that fits has the same bytes as without a limit.
void check_limits(const std::string& file, std::vector<std::string> words) {
    const Folder d;
    words.insert(words.end(), {"-o", file});
    const CommandResult free = d.run_words(words);
    INFO(file << ": " << free.err);
    REQUIRE(free.exit_code == 0);
    const std::string whole = d.read(file);
    const auto size = static_cast<rlim_t>(whole.size());
    for (const rlim_t most : {size - 1, rlim_t{48}}) {
        d.write(file, "old");
        const CommandResult result = limited(d, words, most);
        INFO(most << " of " << size << " bytes: " << result.err);
        CHECK(result.exit_code == 1);
        CHECK(holds(result.err, "error"));
        CHECK(d.read(file) == "old");
        CHECK(std::distance(fs::directory_iterator(d), {}) == 1);
    }
    CHECK(limited(d, words, size + 2).exit_code == 0);
    CHECK(d.read(file) == whole);
}

const std::vector<std::string> k_formats{"png", "jpg", "jpeg", "tif", "tiff", "hdr",
                                         "bmp", "tga", "webp", "exr", "ppm",  "pfm"};

}  // namespace

TEST_CASE("a picture of any format that exceeds the file size limit is an error") {
    for (const std::string& format : k_formats)
        check_limits("a." + format, {"render", "--width", "90", "--height", "61"});
}

TEST_CASE("so is a picture in layers, and one in tiles") {
    check_limits("a.exr", {"render", "--width", "60", "--height", "40", "--terms", "diffuse,normal"});
    check_limits("a.exr", {"render", "--width", "16384", "--height", "3"});
    check_limits("a.tif", {"render", "--width", "16384", "--height", "3"});
}

TEST_CASE("so are a sheet, a heat-map and a diagram") {
    check_limits("a.png", {"compare", "--width", "60", "--height", "40", "--reflection", "phong,lambert"});
    check_limits("a.svg", {"plot", "reflection/phong"});
    const Folder d;
    succeeded(d.run("render -o a.png --width 64 --height 64"));
    succeeded(d.run("render -o b.png --width 64 --height 64 --reflection lambert"));
    CHECK(limited(d, {"diff", "a.png", "b.png", "-o", "heat.ppm"}, 4000).exit_code == 1);
    CHECK_FALSE(d.has("heat.ppm"));
}

TEST_CASE("a part of a picture that does not fit is an error, and is rendered again") {
    const Folder d;
    const std::vector<std::string> part{"render", "-o", "a.png", "--part", "1/2"};
    expect(limited(d, part, 4000), 1, {"File too large"});
    CHECK_FALSE(d.has("a.png.parts/1-of-2.pixels"));
    expect(d.run_words(part), 0);
    expect(d.run("render -o a.png --part 2/2"), 0);
    expect(limited(d, {"assemble", "a.png"}, 500), 1, {"File too large"});
    CHECK_FALSE(d.has("a.png"));
    expect(d.run("assemble a.png"), 0);
}

TEST_CASE("a full disk is an error for every format") {
    const Folder d;
    for (const std::string& format : k_formats) {
        fs::create_symlink("/dev/full", d / ("full." + format));
        const CommandResult result =
            d.run_words({"render", "-o", "full." + format, "--width", "90", "--height", "61"});
        INFO(format << ": " << result.err);
        CHECK(result.exit_code == 1);
        CHECK(holds(result.err, "No space left on device"));
    }
}

TEST_CASE("a limit on threads gives a message or a picture, never a program that waits forever") {
    const Folder d;
    fs::permissions(d, fs::perms::all);
    const auto with = [&](const std::vector<std::string>& words, rlim_t most) {
        // LeakSanitizer starts a thread in the end, and calls it an error if it cannot.
        CommandSetup setup{.environment = {{"ASAN_OPTIONS", "detect_leaks=0"}}, .directory = d};
        setup.prepare = [most] {
            constexpr int k_nobody = 65534;
            if (::geteuid() == 0 && (::setgid(k_nobody) != 0 || ::setuid(k_nobody) != 0)) ::_exit(125);
            const rlimit limit = {most, most};
            if (::setrlimit(RLIMIT_NPROC, &limit) != 0) ::_exit(125);
        };
        return run_candela(words, setup);
    };
    if (with({"--version"}, 4).exit_code != 0) SKIP("nobody else can run the command here");
    for (const rlim_t most : {1, 2, 4, 8, 16}) {
        for (const char* const name : {"a.exr", "a.png", "a.tif"}) {
            fs::remove(d / name);
            const CommandResult result =
                with({"render", "-o", name, "--width", "64", "--height", "64"}, most);
            INFO(most << ' ' << name << ": " << result.err);
            CHECK((result.exit_code == 0 || result.exit_code == 1));
            CHECK(d.has(name) == (result.exit_code == 0));
        }
    }
}
