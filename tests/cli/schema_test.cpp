// candela schema, as a person at a shell meets it.
#include <catch2/catch_test_macros.hpp>
#include <filesystem>
#include <string>

#include "support/command.h"

namespace fs = std::filesystem;

namespace {

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// The command with no plugins but the shipped ones.
CommandResult schema(const std::vector<std::string>& arguments) {
    const fs::path nowhere = scratch_directory();
    std::vector<std::string> words = {"schema"};
    words.insert(words.end(), arguments.begin(), arguments.end());
    return run_candela(words,
                       {.input = "",
                        .environment = {{"XDG_DATA_HOME", nowhere.string()}, {"CANDELA_PLUGIN_PATH", ""}},
                        .directory = {}});
}

}  // namespace

TEST_CASE("docs/scene-reference.md is what candela schema prints") {
    const CommandResult page = schema({"--format", "markdown"});
    CHECK(page.exit_code == 0);
    CHECK(page.err.empty());
    const bool is_fresh = page.out == read_file(fs::path(CANDELA_TEST_SOURCE) / "docs/scene-reference.md");
    if (!is_fresh) {
        FAIL(
            "docs/scene-reference.md is stale; write it again: build/release/bin/candela schema --format "
            "markdown > docs/scene-reference.md");
    }
}

TEST_CASE("candela schema prints a JSON Schema unless told otherwise, on standard output alone") {
    const CommandResult json = schema({});
    CHECK(json.exit_code == 0);
    CHECK(json.err.empty());
    CHECK(json.out.starts_with("{"));
    CHECK(holds(json.out, "http://json-schema.org/draft-07/schema#"));
    CHECK(schema({"--format", "json"}).out == json.out);
    CHECK(schema({"--format=markdown"}).out.starts_with("# Scene reference\n"));
}

TEST_CASE("an unknown format of candela schema is a usage error with a suggestion") {
    const CommandResult wrong = schema({"--format", "markdwon"});
    CHECK(wrong.exit_code == 2);
    CHECK(wrong.out.empty());
    CHECK(holds(wrong.err, "did you mean 'markdown'?"));
    const CommandResult other = schema({"--format", "yaml"});
    CHECK(other.exit_code == 2);
    CHECK(holds(other.err, "json or markdown"));
    CHECK(schema({"scene.toml"}).exit_code == 2);
    CHECK(schema({"--plugin-dir", "/nowhere"}).exit_code == 1);
}
