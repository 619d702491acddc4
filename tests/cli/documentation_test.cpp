// Checks what the documentation shows.
#include "candela/plugin/abi.h"

#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <cctype>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "support/command.h"
#include "support/expect.h"
#include "support/folder.h"
#include "support/text.h"

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

/// The names of the shipped plugins, by kind.
std::map<std::string, std::set<std::string>> shipped() {
    const std::string nowhere = scratch_directory().string();
    const CommandResult list = run_candela(
        {"list", "--json"}, {.environment = {{"XDG_DATA_HOME", nowhere}, {"CANDELA_PLUGIN_PATH", ""}}});
    std::map<std::string, std::set<std::string>> names;
    for (const auto& plugin : nlohmann::json::parse(list.out)) names[plugin["kind"]].insert(plugin["name"]);
    return names;
}

/// The rows of a page's tables whose first cell is `first`; all rows if it is empty.
std::string table_rows(const fs::path& page, const std::string& first) {
    std::istringstream lines(read_file(k_source / page));
    std::string rows;
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with(first.empty() ? "| " : "| " + first + " |")) rows += line + "\n";
    }
    return rows;
}

/// The texts between backquotes.
std::set<std::string> code_in(const std::string& text) {
    std::set<std::string> words;
    for (std::size_t at = text.find('`'); at != std::string::npos; at = text.find('`', at + 1)) {
        const std::size_t end = text.find('`', at + 1);
        REQUIRE(end != std::string::npos);
        words.insert(text.substr(at + 1, end - at - 1));
        at = end;
    }
    return words;
}

/// Each of `names` that is not among `others`, after `kind` and a slash.
std::string missing_from(const std::set<std::string>& others, const std::set<std::string>& names,
                         const std::string& kind) {
    std::string missing;
    for (const std::string& name : names) {
        if (!others.contains(name)) missing += " " + kind + "/" + name;
    }
    return missing;
}

CommandResult check(const fs::path& file) { return run_candela({"check", file.string()}); }

}  // namespace

TEST_CASE("the README's scene is valid, and its mistake is explained as shown there") {
    const Folder directory;
    std::string scene = block("README.md", "toml");
    const CommandResult good = expect(check(directory.write("good.toml", scene)), 0);
    CHECK(good.err.empty());

    scene.replace(scene.find("intensity"), 9, "intensty");
    directory.write("ball.toml", scene);
    const CommandResult bad = directory.run("check ball.toml");
    CHECK(bad.exit_code == 3);
    CHECK(bad.err == block("README.md", "text"));
}

TEST_CASE("the scene of docs/user/scene-file.md is valid") {
    const Folder directory({{"lights.toml", "[[light]]\ntype = \"ambient\"\n"}});
    expect(check(directory.write("scene.toml", block("docs/user/scene-file.md", "toml"))), 0);
}

TEST_CASE("docs/plugins/versioning.md states this interface version and this fingerprint") {
    const std::string text = read_file(k_source / "docs/plugins/versioning.md");
    const std::string version = std::to_string(CANDELA_INTERFACE_VERSION);
    CHECK(block("docs/plugins/versioning.md", "text") == std::string(CANDELA_ABI) + "\n");
    CHECK(holds(text, "| interface version, `" + version + "` |"));
    CHECK(holds(text, "`candela-plugin-interface-" + version + "`"));
    CHECK(holds(text, "this is '" + std::string(CANDELA_ABI)));
}

TEST_CASE("the example scenes are valid") {
    int checked = 0;
    for (const auto& entry : fs::directory_iterator(k_source / "docs/examples")) {
        if (entry.path().extension() != ".toml") continue;
        expect(check(entry.path()), 0);
        ++checked;
    }
    CHECK(checked > 0);
}

// A model is its folder: adding one must not require a line here or there, but existing lines must be right.
TEST_CASE("the README's table of models names shipped plugins, and nothing else") {
    std::string unknown;
    for (const auto& [kind, names] : shipped()) {
        const std::set<std::string> named =
            code_in(table_rows("README.md", kind == "image" ? "picture" : kind));
        CHECK_FALSE(named.empty());
        unknown += missing_from(names, named, kind);
    }
    INFO("README.md, Models: in the table, but not shipped:" << unknown);
    CHECK(unknown.empty());
}

TEST_CASE(
    "docs/user/equations.md has a row for every light, reflection model and shading model of the README") {
    std::string table = table_rows("docs/user/equations.md", "");
    std::ranges::transform(table, table.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    std::string missing;
    for (const std::string kind : {"light", "reflection", "shading"}) {
        const std::set<std::string> shipped_names = shipped()[kind];
        for (const std::string& name : code_in(table_rows("README.md", kind))) {
            if (!shipped_names.contains(name)) continue;
            std::istringstream words(name);
            bool is_there = true;
            for (std::string word; std::getline(words, word, '-');)
                is_there = is_there && table.find(word) != std::string::npos;
            if (!is_there) missing += " " + kind + "/" + name;
        }
    }
    INFO("docs/user/equations.md has no row for" << missing);
    CHECK(missing.empty());
}

TEST_CASE("the pages that help, comments and scripts name exist") {
    const std::string path = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_./";
    std::string missing;
    int count = 0;
    for (const char* const folder : {"apps", "core", "plugins", "scripts", "sdk", "tests"}) {
        for (const auto& entry : fs::recursive_directory_iterator(k_source / folder)) {
            if (!entry.is_regular_file()) continue;
            const std::string text = read_file(entry.path());
            for (std::size_t at = text.find("docs/"); at != std::string::npos;
                 at = text.find("docs/", at + 1)) {
                const std::string name = text.substr(at, text.find_first_not_of(path, at) - at);
                const std::size_t end = name.find(".md");
                if (end == std::string::npos || name.starts_with("docs/site")) continue;
                ++count;
                if (!fs::exists(k_source / name.substr(0, end + 3)))
                    missing += "\n" + entry.path().string() + ": " + name;
            }
        }
    }
    INFO("missing:" << missing);
    CHECK(missing.empty());
    CHECK(count > 20);
}

TEST_CASE("the twelve files to read in docs/internals/architecture.md exist") {
    std::istringstream lines(table_rows("docs/internals/architecture.md", ""));
    std::set<std::string> found;
    std::string missing;
    for (std::string line; std::getline(lines, line);) {
        if (std::isdigit(static_cast<unsigned char>(line[2])) == 0) continue;
        const std::size_t begin = line.find('`') + 1;
        const std::string file = line.substr(begin, line.find('`', begin) - begin);
        found.insert(file);
        if (!fs::is_regular_file(k_source / file)) missing += " " + file;
    }
    INFO("missing:" << missing);
    CHECK(missing.empty());
    CHECK(found.size() == 12);
}

TEST_CASE("the commands in the documentation can be run as printed") {
    const Folder d;
    const auto run = [&](const std::vector<std::string>& words) { return d.run_words(words); };
    d.write("ball.toml", block("README.md", "toml"));
    d.write("velvet.kernel", block("docs/plugins/adding-a-model.md", "glsl"));
    for (const char* const image : {"a.png", "b.png", "before.png", "after.png", "before.exr", "after.exr"})
        REQUIRE(run({"render", "-o", image, "--width", "64", "--height", "64"}).exit_code == 0);
    std::vector<fs::path> pages{"README.md"};
    for (const fs::path folder : {"docs", "docs/user", "docs/plugins", "docs/internals"})
        for (const auto& entry : fs::directory_iterator(k_source / folder))
            if (entry.path().extension() == ".md") pages.push_back(folder / entry.path().filename());
    const std::set<std::string> verbs{"check", "compare", "describe", "diff",
                                      "edit",  "explain", "list",     "plot"};
    int count = 0;
    for (const fs::path& page : pages) {
        std::istringstream lines(read_file(k_source / page));
        for (std::string line; std::getline(lines, line);) {
            std::istringstream text(line.substr(0, line.find(" #")));
            std::vector<std::string> words;
            for (std::string word; text >> word;) words.push_back(word);
            if (words.size() < 2 || words[0] != "candela" || !verbs.contains(words[1])) continue;
            // Commands that need an earlier build by the reader, or a shell.
            if (line.find_first_of("|<>") != std::string::npos ||
                line.find("--plugin-dir") != std::string::npos ||
                line.find("reflection/cel") != std::string::npos)
                continue;
            REQUIRE(run({"new", "--force"}).exit_code == 0);
            if (words[1] == "compare") words.insert(words.end(), {"--width", "32", "--height", "24"});
            words.erase(words.begin());
            const CommandResult result = run(words);
            INFO(page.string() << ": " << line << '\n' << result.err);
            CHECK(result.exit_code == 0);
            ++count;
        }
    }
    CHECK(count > 20);
}

TEST_CASE("the commands and values that help gives as examples can be used as printed") {
    const Folder d;
    const auto run = [&](const std::vector<std::string>& words) { return d.run_words(words); };
    const auto help_of = [&](const std::string& verb) {
        std::istringstream words(run({verb, "--help"}).out);
        std::string text;
        for (std::string word; words >> word;) text += word + ' ';
        return text;
    };
    const auto in_scene = [&](std::vector<std::string> words) {
        REQUIRE(run({"new", "scene.toml", "--force"}).exit_code == 0);
        words.insert(words.begin() + 1, "scene.toml");
        const CommandResult result = run(words);
        INFO(words[0] << ' ' << words[2] << ' ' << words.back() << ": " << result.err);
        CHECK(result.exit_code == 0);
    };
    /// The words after "such as ", up to the end of the example.
    const auto examples_in = [](const std::string& help) {
        std::set<std::string> examples;
        const std::string_view mark = "such as ";
        for (std::size_t at = help.find(mark); at != std::string::npos; at = help.find(mark, at + 1)) {
            std::string word =
                help.substr(at + mark.size(), help.find_first_of(" ;)", at + mark.size()) - at - mark.size());
            if (word.find('=') != std::string::npos) examples.insert(word);
        }
        return examples;
    };

    const std::string compare = help_of("compare");
    const std::size_t begin = compare.find("candela compare scene.toml"), end = compare.find('.', begin + 24);
    REQUIRE(end != std::string::npos);
    std::istringstream command(compare.substr(begin, end - begin));
    std::vector<std::string> words;
    for (std::string word; command >> word;) words.push_back(word);
    REQUIRE(words.size() > 4);
    REQUIRE(run({"new", "scene.toml"}).exit_code == 0);
    words.erase(words.begin());
    words.insert(words.end(), {"--width", "32", "--height", "24"});
    expect(run(words), 0);

    const std::vector<std::string> small = {"--width", "32", "--height", "24"};
    std::size_t count = 0;
    for (const std::string& example : examples_in(help_of("render"))) {
        const char* const option = example.starts_with("quality") ? "--format-set" : "--set";
        in_scene(joined({"render", option, example, "-o", "a.jpg"}, small));
        ++count;
    }
    for (const std::string& example : examples_in(help_of("edit"))) {
        in_scene({"edit", "--change", example});
        ++count;
    }
    for (const std::string& example : examples_in(compare)) {
        if (example.find(',') == std::string::npos) continue;  // an example of another option
        in_scene(joined({"compare", "--vary", example}, small));
        ++count;
    }
    CHECK(count >= 4);
}
