// Completion for shells, and the manual pages: both say what --help says.
#include <catch2/catch_test_macros.hpp>
#include <filesystem>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "support/command.h"

namespace fs = std::filesystem;

namespace {

const std::string k_examples = CANDELA_TEST_SOURCE "/docs/examples/";
const fs::path k_shells = CANDELA_TEST_SOURCE "/apps/candela/shells";

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

/// What the last of the words may become, without meanings.
std::set<std::string> completions(const std::vector<std::string>& words) {
    const CommandResult result =
        run_candela(words, {.input = {}, .environment = {{"CANDELA_COMPLETE", "1"}}, .directory = {}});
    CHECK(result.exit_code == 0);
    CHECK(result.err.empty());
    std::set<std::string> found;
    for (const std::string& line : lines_of(result.out))
        found.insert(line.starts_with('\t') ? line : line.substr(0, line.find('\t')));
    return found;
}

using Words = std::set<std::string>;

/// What a script prints in a shell that has the command on its PATH.
std::string in_shell(const std::vector<std::string>& shell, const std::string& script) {
    std::vector<std::string> words = shell;
    words.push_back("PATH=" + fs::path(CANDELA_TEST_COMMAND).parent_path().string() + ":$PATH\n" + script);
    const CommandResult result = run_program(words);
    CHECK(result.err.empty());
    return result.out;
}

}  // namespace

TEST_CASE("completion: verbs, options, and names of plugins") {
    CHECK(completions({"re"}) == Words{"render"});
    CHECK(completions({"help", "sch"}) == Words{"schema"});
    CHECK(completions({"plugin", ""}) == Words{"new", "test", "doctor"});
    CHECK(completions({"render", "--sh"}) == Words{"--shading"});
    CHECK(completions({"render", "--reflection", "oren"}) == Words{"oren-nayar"});
    CHECK(completions({"render", "--reflection=oren"}) == Words{"--reflection=oren-nayar"});
    CHECK(completions({"compare", "--reflection", "phong,gg"}) == Words{"phong,ggx"});
    CHECK(completions({"describe", "shape/to"}) == Words{"shape/torus"});
    CHECK(completions({"list", "refl"}) == Words{"reflection"});
    CHECK(completions({"plot", "ggx:roughness=0.2,i"}) == Words{"ggx:roughness=0.2,ior="});
    CHECK(completions({"diff", "a.png", "--tol"}) == Words{"--tolerance"});
    CHECK(completions({"render", "--samples", ""}) == Words{"1", "4", "8", "16"});
}

TEST_CASE("completion: what can be set in a scene, part by part") {
    const std::string scene = k_examples + "still-life.toml";
    const Words lights = completions({"render", scene, "--set", "light."});
    CHECK(lights == Words{"light.sky.", "light.lamp.", "light.window.", "light.moon."});
    CHECK(completions({"render", scene, "--set", "light.lamp.outer"}) == Words{"light.lamp.outer_angle="});
    CHECK(completions({"edit", scene, "--change", "object.ball.material.shin"}) ==
          Words{"object.ball.material.shininess="});
    CHECK(completions({"render", "--set", "image.color_management="}) ==
          Words{"image.color_management=srgb", "image.color_management=none"});
    CHECK(completions({"render", "--set", "shading.model=go"}) == Words{"shading.model=gouraud"});
    CHECK(completions({"render", "--set", "nothing.of."}).empty());
    CHECK(completions({"render", "--format-set", "qua"}) == Words{"quality="});
}

TEST_CASE("completion: files are left to the shell, and mistakes before the cursor are borne") {
    CHECK(completions({"render", ""}) == Words{"\tfiles"});
    CHECK(completions({"render", "-o", ""}) == Words{"\tfiles"});
    CHECK(completions({"render", "--plugin-dir", ""}) == Words{"\tfolders"});
    CHECK(completions({"render", "--wrong", "--threads", "many", "--sh"}) == Words{"--shading"});
    CHECK(completions({"render", "no-such-scene.toml", "--set", "obser"}) == Words{"observer."});
}

TEST_CASE("completion works in bash, zsh and fish") {
    const std::string bash = in_shell(
        {"bash", "-c"},
        "source " + (k_shells / "candela.bash").string() +
            "\ncompopt() { :; }\n"  // it works in readline only
            "complete_line() { COMP_LINE=$1 COMP_POINT=${#1}; _candela; echo \"${COMPREPLY[*]}\"; }\n"
            "complete_line 'candela ren'\ncomplete_line 'candela render --reflection=gg'\n"
            "complete_line 'candela render --set light.'\ncomplete_line 'candela plot ggx:rou'\n");
    CHECK(bash == "render\nggx\nlight.lamp.\nroughness=\n");

    const std::string zsh =
        in_shell({"zsh", "-f", "-c"},
                 "compadd() { print -r -- \"${@[$#]}\" }\n_files() { print files $* }\n"  // they work in its
                                                                                          // editor only
                 "functions[_candela]=$(<" +
                     (k_shells / "_candela").string() +
                     ")\n"
                     "words=(candela ren) CURRENT=2; _candela\nwords=(candela render --reflection gg) "
                     "CURRENT=4; _candela\n"
                     "words=(candela render --set light.) CURRENT=4; _candela\nwords=(candela render "
                     "--plugin-dir '') CURRENT=4; _candela\n");
    CHECK(zsh == "render\nggx\nlight.lamp.\nfiles -/\n");

    const fs::path home = scratch_directory();
    const std::string fish = in_shell({"env", "HOME=" + home.string(), "bash", "-c"},
                                      "fish -c 'source " + (k_shells / "candela.fish").string() +
                                          "; for line in \"candela ren\" \"candela render --reflection gg\" "
                                          "\"candela render --set light.\"; "
                                          "complete -C $line | cut -f 1; end'");
    CHECK(fish == "render\nggx\nlight.lamp.\n");
}

TEST_CASE("every verb has a manual page with every option that its help has") {
    const CommandResult overview = run_candela({"--help-as", "man"});
    int verbs = 0;
    for (const std::string& verb : completions({""})) {
        CHECK(overview.out.find("\n.B " + verb + "\n") != std::string::npos);
        if (verb == "plugin" || verb == "exercise") continue;  // their verbs have pages
        INFO(verb);
        ++verbs;
        const CommandResult help = run_candela(
            {verb, "--help"}, {.input = {}, .environment = {{"COLUMNS", "200"}}, .directory = {}});
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
            CHECK(page.out.find(in_troff) != std::string::npos);
        }
    }
    CHECK(verbs >= 15);
}
