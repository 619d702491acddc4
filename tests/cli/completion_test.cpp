// Completion for shells, and the manual pages: both agree with --help. tests/cli/shells runs the shells
// themselves.
#include <catch2/catch_test_macros.hpp>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "support/command.h"
#include "support/text.h"

namespace fs = std::filesystem;

namespace {

const std::string k_examples = CANDELA_TEST_SOURCE "/docs/examples/";

/// The completions of the last word, without meanings.
std::set<std::string> completions(const std::vector<std::string>& words, const fs::path& directory = {}) {
    const CommandResult result =
        run_candela(words, {.input = {}, .environment = {{"CANDELA_COMPLETE", "1"}}, .directory = directory});
    CHECK(result.exit_code == 0);
    CHECK(result.err.empty());
    std::set<std::string> found;
    for (const std::string& line : lines_of(result.out))
        found.insert(line.starts_with('\t') ? line : line.substr(0, line.find('\t')));
    return found;
}

using Offered = std::set<std::string>;

}  // namespace

TEST_CASE("completion: verbs, options, and names of plugins") {
    CHECK(completions({"re"}) == Offered{"render"});
    CHECK(completions({"help", "sch"}) == Offered{"schema"});
    CHECK(completions({"plugin", ""}) == Offered{"new", "test", "doctor"});
    CHECK(completions({"render", "--shad"}) == Offered{"--shading", "--shadows"});
    CHECK(completions({"render", "--reflection", "oren"}) == Offered{"oren-nayar"});
    CHECK(completions({"render", "--reflection=oren"}) == Offered{"--reflection=oren-nayar"});
    CHECK(completions({"compare", "--reflection", "phong,gg"}) == Offered{"phong,ggx"});
    CHECK(completions({"describe", "shape/to"}) == Offered{"shape/torus"});
    CHECK(completions({"list", "refl"}) == Offered{"reflection"});
    CHECK(completions({"plot", "ggx:roughness=0.2,i"}) == Offered{"ggx:roughness=0.2,ior="});
    CHECK(completions({"diff", "a.png", "--tol"}) == Offered{"--tolerance"});
    CHECK(completions({"render", "--samples", ""}) == Offered{"1", "4", "8", "16"});
}

TEST_CASE("completion: kernel files are offered next to the models' names") {
    const fs::path folder = scratch_directory();
    std::ofstream(folder / "velvet.kernel") << "";
    std::ofstream(folder / "velvet.txt") << "";
    const auto in_folder = [&](const std::vector<std::string>& words) { return completions(words, folder); };
    CHECK(in_folder({"render", "--reflection", "vel"}) == Offered{"velvet.kernel"});
    CHECK(in_folder({"compare", "--reflection", "phong,vel"}) == Offered{"phong,velvet.kernel"});
    CHECK(in_folder({"plot", "vel"}) == Offered{"velvet.kernel"});
    CHECK(in_folder({"describe", "vel"}) == Offered{"velvet.kernel"});
    // The shell completes paths.
    CHECK(in_folder({"render", "--shading", "./vel"}) == Offered{"\tfiles"});
    CHECK(in_folder({"describe", "kernels/vel"}) == Offered{"\tfiles"});
}

TEST_CASE("completion: what can be set in a scene, part by part") {
    const std::string scene = k_examples + "still-life.toml";
    const Offered lights = completions({"render", scene, "--set", "light."});
    CHECK(lights == Offered{"light.sky.", "light.lamp.", "light.window.", "light.moon."});
    CHECK(completions({"render", scene, "--set", "light.lamp.outer"}) == Offered{"light.lamp.outer_angle="});
    CHECK(completions({"edit", scene, "--change", "object.ball.material.shin"}) ==
          Offered{"object.ball.material.shininess="});
    CHECK(completions({"render", "--set", "image.color_management="}) ==
          Offered{"image.color_management=srgb", "image.color_management=none"});
    CHECK(completions({"render", "--set", "shading.model=go"}) == Offered{"shading.model=gouraud"});
    CHECK(completions({"render", "--set", "nothing.of."}).empty());
    CHECK(completions({"render", "--format-set", "qua"}) == Offered{"quality="});
}

TEST_CASE("completion: files are left to the shell, and mistakes before the cursor are tolerated") {
    CHECK(completions({"render", ""}) == Offered{"\tfiles"});
    CHECK(completions({"render", "-o", ""}) == Offered{"\tfiles"});
    CHECK(completions({"render", "--plugin-dir", ""}) == Offered{"\tfolders"});
    CHECK(completions({"render", "--wrong", "--threads", "many", "--sha"}) ==
          Offered{"--shading", "--shadows"});
    CHECK(completions({"render", "no-such-scene.toml", "--set", "obser"}) == Offered{"observer."});
}

namespace {

/// The replacements of `replaced`, the end of a line typed in bash.
std::set<std::string> insertions(const std::string& line, const std::string& replaced,
                                 const fs::path& directory = {}) {
    const CommandResult result =
        run_candela({line, replaced},
                    {.input = {}, .environment = {{"CANDELA_COMPLETE", "bash"}}, .directory = directory});
    CHECK(result.exit_code == 0);
    CHECK(result.err.empty());
    const std::vector<std::string> lines = lines_of(result.out);
    return {lines.begin(), lines.end()};
}

fs::path scene_with(const std::vector<std::string>& names_in_toml) {
    std::string objects;
    for (const std::string& name : names_in_toml) objects += "{type = \"cube\"" + name + "}, ";
    const std::string text =
        "version = 1\nobserver = {position = [0, 1, 4], look_at = [0, 0, 0]}\nobject = [" + objects + "]\n";
    return write_file(scratch_directory() / "s.toml", text);
}

}  // namespace

TEST_CASE("completion in bash: inserted words are quoted for their place") {
    using Insertions = std::set<std::string>;
    CHECK(insertions("candela ren", "ren") == Insertions{"render"});
    CHECK(insertions("candela render --reflection=gg", "gg") == Insertions{"ggx"});
    CHECK(insertions("candela render --set light.", "light.") == Insertions{"light.lamp."});
    CHECK(insertions("candela plot ggx:rou", "rou") == Insertions{"roughness="});
    CHECK(insertions("candela render ", "") == Insertions{"\tfiles"});
    const fs::path folder = scene_with({R"x(, name = "box$(touch${IFS}X)")x"}).parent_path();
    const std::string before = "candela render s.toml --set ";
    CHECK(insertions(before + "object.b", "object.b", folder) ==
          Insertions{R"x(object.box\$\(touch\$\{IFS\}X\).)x"});
    CHECK(insertions(before + "'object.b", "object.b", folder) == Insertions{"object.box$(touch${IFS}X)."});
    CHECK(insertions(before + "\"object.b", "object.b", folder) ==
          Insertions{R"x(object.box\$(touch\${IFS}X).)x"});
    CHECK(insertions(before + R"x(object.box\$)x", R"x(object.box\$)x", folder) ==
          Insertions{R"x(object.box\$\(touch\$\{IFS\}X\).)x"});
    // Readline would leave the text before it, and the shell would execute that.
    CHECK(insertions(before + "object.box$(tou", "tou", folder).empty());
    CHECK(insertions(before + "$'object.b", "object.b", folder).empty());
    CHECK(insertions(before + "object.box`tou", "tou", folder).empty());
    CHECK(insertions(before + "\"object.box$(tou", "object.box$(tou", folder) ==
          Insertions{R"x(object.box\$(touch\${IFS}X).)x"});
}

TEST_CASE(
    "completion offers only words that can be typed: an index instead of a name that a path cannot contain") {
    const std::string scene =
        scene_with({"", R"(, name = "a.b")", R"(, name = "a=b")", R"(, name = "plain")"}).string();
    CHECK(completions({"render", scene, "--set", "object."}) ==
          Offered{"object.0.", "object.1.", "object.2.", "object.plain."});
    CHECK(completions({"render", scene, "--set", "object.1.position"}) == Offered{"object.1.position="});
    const std::string hidden =
        scene_with({R"(, name = "two\nlines")", R"(, name = "bell\u0007")", R"(, name = "a\ttab")"}).string();
    CHECK(completions({"render", hidden, "--set", "object."}) ==
          Offered{"object.0.", "object.1.", "object.2."});
}

TEST_CASE("completion offers no name that would be taken for an option") {
    const fs::path folder = scratch_directory();
    const fs::path plugins = fs::path(CANDELA_TEST_PLUGINS);
    std::string manifest = read_file(plugins / "reflection-lambert.json");
    const std::string name = "\"name\": \"lambert\"";
    const std::size_t at = manifest.find(name);
    REQUIRE(at != std::string::npos);
    write_file(folder / "reflection--x.json", manifest.replace(at, name.size(), "\"name\": \"-x\""));
    fs::copy_file(plugins / "reflection-lambert.so", folder / "reflection--x.so");
    const std::string where = "--plugin-dir=" + folder.string();
    CHECK_FALSE(completions({"render", where, "--reflection", ""}).contains("-x"));
    CHECK(completions({"render", where, "--reflection=-"}) == Offered{"--reflection=-x"});
    CHECK(completions({"describe", where, "reflection/-"}) == Offered{"reflection/-x"});
}

TEST_CASE("every verb has a manual page with every option of its help") {
    const CommandResult overview = run_candela({"--help-as", "man"});
    int verbs = 0;
    for (const std::string& verb : completions({""})) {
        CHECK(holds(overview.out, "\n.B " + verb + "\n"));
        if (verb == "plugin" || verb == "exercise") continue;  // their subverbs have pages
        INFO(verb);
        ++verbs;
        const CommandResult help =
            run_candela({verb, "--help"}, {.input = {}, .environment = {{"COLUMNS", "200"}}});
        const CommandResult page = run_candela({verb, "--help-as", "man"});
        CHECK(page.exit_code == 0);
        CHECK(page.out.starts_with(".TH "));
        CHECK(fs::exists(fs::path(CANDELA_TEST_COMMAND).parent_path().parent_path() / "share/man/man1" /
                         ("candela-" + verb + ".1.gz")));
        const std::regex option("--[a-z-]+");
        const std::string shown = help.out.substr(help.out.find("\nOptions:"));
        for (std::sregex_iterator each(shown.begin(), shown.end(), option), end; each != end; ++each) {
            const std::string in_troff = std::regex_replace(each->str(), std::regex("-"), R"(\-)");
            INFO(each->str());
            CHECK(holds(page.out, in_troff));
        }
    }
    CHECK(verbs >= 15);
}
