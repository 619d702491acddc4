// What the documentation shows must be so.
#include "candela/abi.h"

#include <catch2/catch_test_macros.hpp>
#include <filesystem>
#include <string>

#include "support/command.h"

namespace fs = std::filesystem;

namespace {

const fs::path k_source = CANDELA_TEST_SOURCE;

/// The `number`-th block of a Markdown file fenced with ```language, without its fences.
std::string block(const fs::path& file, const std::string& language, int number = 0) {
    const std::string text = read_file(k_source / file);
    const std::string fence = "\n```" + language + "\n";
    std::size_t begin = 0;
    for (int i = 0; i <= number; ++i) {
        begin = text.find(fence, i == 0 ? 0 : begin);
        REQUIRE(begin != std::string::npos);
        begin += fence.size();
    }
    return text.substr(begin, text.find("\n```", begin) + 1 - begin);
}

CommandResult check(const fs::path& file) { return run_candela({"check", file.string()}); }

}  // namespace

TEST_CASE("the README's scene is valid, and its mistake is explained as it says") {
    const fs::path directory = scratch_directory();
    std::string scene = block("README.md", "toml");
    const CommandResult good = check(write_file(directory / "good.toml", scene));
    INFO(good.err);
    CHECK(good.exit_code == 0);
    CHECK(good.err.empty());

    scene.replace(scene.find("intensity"), 9, "intensty");
    write_file(directory / "ball.toml", scene);
    const CommandResult bad =
        run_candela({"check", "ball.toml"}, {.input = "", .environment = {}, .directory = directory});
    CHECK(bad.exit_code == 3);
    CHECK(bad.err == block("README.md", "text"));
}

TEST_CASE("the scene of docs/scene-file.md is valid") {
    const fs::path directory = scratch_directory();
    write_file(directory / "lights.toml", "[[light]]\ntype = \"ambient\"\n");
    const CommandResult result =
        check(write_file(directory / "scene.toml", block("docs/scene-file.md", "toml")));
    INFO(result.err);
    CHECK(result.exit_code == 0);
}

TEST_CASE("docs/versioning.md speaks of this interface version, and of this fingerprint") {
    const std::string text = read_file(k_source / "docs/versioning.md");
    const std::string version = std::to_string(CANDELA_INTERFACE_VERSION);
    CHECK(block("docs/versioning.md", "text") == std::string(CANDELA_ABI) + "\n");
    CHECK(text.find("| interface version, `" + version + "` |") != std::string::npos);
    CHECK(text.find("`candela-plugin-interface-" + version + "`") != std::string::npos);
    CHECK(text.find("this is '" + std::string(CANDELA_ABI)) != std::string::npos);
}

TEST_CASE("the example scenes are valid") {
    int checked = 0;
    for (const auto& entry : fs::directory_iterator(k_source / "docs/examples")) {
        if (entry.path().extension() != ".toml") continue;
        const CommandResult result = check(entry.path());
        INFO(result.err);
        CHECK(result.exit_code == 0);
        ++checked;
    }
    CHECK(checked > 0);
}
