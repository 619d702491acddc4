// candela schema as used from a shell.
#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "support/command.h"
#include "support/expect.h"
#include "support/text.h"

namespace fs = std::filesystem;

namespace {

/// A Markdown page's sections by their headings, each as its lines.
std::map<std::string, std::vector<std::string>> sections(const std::string& page) {
    std::map<std::string, std::vector<std::string>> result;
    std::istringstream lines(page);
    std::string heading;
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("## ") || line.starts_with("### ")) heading = line;
        result[heading].push_back(line);
    }
    return result;
}

/// Whether a section lists plugins, one per line, rather than describing one.
bool is_list(const std::string& heading) {
    return heading == "## Picture formats" || heading == "## Targets";
}

/// Whether all lines are among the others, in their order.
bool is_part(const std::vector<std::string>& lines, const std::vector<std::string>& others) {
    auto at = others.begin();
    return std::ranges::all_of(lines, [&](const std::string& line) {
        at = std::find(at, others.end(), line);
        return at != others.end();
    });
}

/// The command with only the shipped plugins.
CommandResult schema(const std::vector<std::string>& arguments) {
    const fs::path nowhere = scratch_directory();
    return run_candela(joined({"schema"}, arguments),
                       {.environment = {{"XDG_DATA_HOME", nowhere.string()}, {"CANDELA_PLUGIN_PATH", ""}}});
}

}  // namespace

// A model is its folder: adding one must not require a section here, but every existing section must be
// right.
TEST_CASE("docs/user/scene-reference.md is the output of candela schema for the plugins that it describes") {
    const CommandResult page = schema({"--format", "markdown"});
    CHECK(page.exit_code == 0);
    CHECK(page.err.empty());
    const auto printed = sections(page.out);
    const auto committed =
        sections(read_file(fs::path(CANDELA_TEST_SOURCE) / "docs/user/scene-reference.md"));
    std::string stale;
    for (const auto& [heading, lines] : committed) {
        const auto found = printed.find(heading);
        const bool is_fresh = found != printed.end() &&
                              (is_list(heading) ? is_part(lines, found->second) : lines == found->second);
        if (!is_fresh) stale += " '" + heading + "'";
    }
    for (const auto& [heading, lines] : printed) {
        const bool is_plugin = heading.find('/') != std::string::npos;
        if (!is_plugin && !committed.contains(heading)) stale += " '" + heading + "'";
    }
    INFO("docs/user/scene-reference.md is stale in"
         << stale
         << "; write it again: build/release/bin/candela schema --format "
            "markdown > docs/user/scene-reference.md");
    CHECK(committed.size() > 30);
    CHECK(stale.empty());
}

TEST_CASE("candela schema prints a JSON Schema by default, only on standard output") {
    const CommandResult json = schema({});
    CHECK(json.exit_code == 0);
    CHECK(json.err.empty());
    CHECK(json.out.starts_with("{"));
    CHECK(holds(json.out, "http://json-schema.org/draft-07/schema#"));
    CHECK(schema({"--format", "json"}).out == json.out);
    CHECK(schema({"--format=markdown"}).out.starts_with("# Scene reference\n"));
}

TEST_CASE("an unknown format for candela schema is a usage error with a suggestion") {
    const CommandResult wrong = schema({"--format", "markdwon"});
    CHECK(wrong.exit_code == 2);
    CHECK(wrong.out.empty());
    CHECK(holds(wrong.err, "did you mean 'markdown'?"));
    expect(schema({"--format", "yaml"}), 2, {"json or markdown"});
    CHECK(schema({"scene.toml"}).exit_code == 2);
    CHECK(schema({"--plugin-dir", "/nowhere"}).exit_code == 1);
}
