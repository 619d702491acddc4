// Names are arbitrary text, and must never become part of a program.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "support/command.h"
#include "support/expect.h"
#include "support/scene_tables.h"
#include "support/text.h"

namespace fs = std::filesystem;

namespace {

const std::vector<std::string> k_hostile = {
    "\"; system(\"true\"); //",
    "line\nbreak",
    "*/ int main() { return 7; } /*",
    "</script><script>document.title = 'broken'</script>",
    "<!-- <script>",
    "<img src=x onerror=\"document.title = 'broken'\">",
    ")glsl\" + 1",
    "back\\",
    "trigraph ?\?/",
    "@TITLE@ @SCENE@ @OBJECTS@",
    "\u2028 \u202e right to left",
    "\xe2\x98\x95 \xc3\xa4\xc3\xb6\xc3\xbc \xe7\x90\x83",
    "${PATH} $(true) `true` %s %n {} {0}",
    "\t\x01\x7f",
    "'",
    "\"",
    "\\",
    "#include <x>",
    "R\"(",
    "]]>",
    "-->",
    "&lt;",
    "\r\n",
};

/// Words from a hostile alphabet.
std::string chance_name(std::mt19937& chance) {
    static const std::vector<std::string> k_pieces = {
        "\"", "'", "\\", "\n", "*/", "/*",       "//", "</script>", "<", ">", "&",    "@",    "{", "}",
        "(",  ")", ";",  "#",  "%",  "\xc3\xa9", "a",  "Z",         "0", " ", "?\?/", "R\"(", "`", "$"};
    std::string name;
    for (int i = 0; i < 12; ++i) name += k_pieces[chance() % k_pieces.size()];
    return name;
}

std::string quoted(const std::string& text) { return nlohmann::json(text).dump(-1, ' ', true); }

/// TOML has \u escapes like JSON, except for surrogates, which do not occur here.
std::string scene_with(const std::vector<std::string>& names) {
    std::string text = k_start + image_table(48, 32) + models("phong", "lambert");
    for (std::size_t i = 0; i < names.size(); ++i) {
        text += fmt::format("[[light]]\nname = {}\ntype = \"ambient\"\nintensity = 0.01\n",
                            quoted("light " + names[i]));
        text += fmt::format("[[object]]\nname = {}\ntype = \"cube\"\nsize = 0.1\nposition = [{}, {}, 0]\n",
                            quoted(names[i]), -1.4 + 0.2 * static_cast<double>(i % 15),
                            -1.0 + 0.2 * static_cast<double>(i / 15));
    }
    return text;
}

std::vector<std::string> all_names() {
    std::vector<std::string> names = k_hostile;
    std::mt19937 chance(7);
    while (names.size() < 90) {
        const std::string name = chance_name(chance);
        if (std::ranges::find(names, name) == names.end()) names.push_back(name);
    }
    return names;
}

void generate(const std::string& target, const fs::path& scene, const fs::path& directory) {
    succeeded(run_candela({"generate", scene.string(), "--target", target, "-o", directory.string()}));
}

std::vector<std::string> tame_names(std::size_t count) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < count; ++i) names.push_back(fmt::format("n{}", i));
    return names;
}

}  // namespace

TEST_CASE("names: C++ programs of scenes with hostile names compile and draw the same as with harmless names",
          "[whole]") {
    const fs::path directory = scratch_directory();
    const std::vector<std::string> names = all_names();
    const auto image = [&](const std::vector<std::string>& with, const std::string& file) {
        const fs::path scene = write_file(directory / file, scene_with(with));
        generate("cpp", scene, directory / "program");
        const fs::path program = directory / "program/scene";
        const CommandResult compiled =
            run_program({"g++", "-std=c++17", "-Wall", "-Wextra", "-Werror", "-o", program.string(),
                         (directory / "program/scene.cpp").string()});
        INFO(compiled.err.substr(0, 2000));
        REQUIRE(compiled.exit_code == 0);
        succeeded(run_program({program.string(), (directory / "scene.ppm").string()}));
        return read_file(directory / "scene.ppm");
    };
    const std::string tame = image(tame_names(names.size()), "tame.toml");
    CHECK(image(names, "hostile.toml") == tame);
    // The file's name becomes the title.
    for (const char* const file : {"*\n#error x\n*.toml", "a\\\nb.toml", "\"); }\\.toml", "@OBJECTS@.toml"})
        CHECK(image(tame_names(names.size()), file) == tame);
}

TEST_CASE("names: the OpenGL program of a scene with hostile names is C++ without a warning") {
    const fs::path directory = scratch_directory();
    const fs::path scene = write_file(directory / "\"\\\n.toml", scene_with(all_names()));
    generate("opengl", scene, directory / "program");
    const CommandResult compiled = run_program({"g++", "-std=c++17", "-Wall", "-Wextra", "-Werror",
                                                "-fsyntax-only", (directory / "program/scene.cpp").string()});
    INFO(compiled.err.substr(0, 2000));
    CHECK(compiled.exit_code == 0);
}

TEST_CASE("names: a page contains hostile names as complete data, and no part of them as markup") {
    const fs::path directory = scratch_directory();
    const std::vector<std::string> names = all_names();
    const auto page_of = [&](const std::vector<std::string>& with, const std::string& file) {
        generate("webgl", write_file(directory / file, scene_with(with)), directory / "page");
        return read_file(directory / "page/scene.html");
    };
    const std::string tame = page_of(tame_names(names.size()), "tame.toml");
    const std::string hostile = page_of(names, "<b onclick='x'>&\"\n.toml");
    for (const char* const tag : {"<script", "</script", "<!--", "<img", "<b", "<style", "</style"}) {
        INFO(tag);
        CHECK(count_of(hostile, tag) == count_of(tame, tag));
    }
    const std::string opening = "<script type=\"application/json\" id=\"scene\">";
    const std::size_t begin = hostile.find(opening) + opening.size();
    const auto scene = nlohmann::json::parse(hostile.substr(begin, hostile.find("</script>", begin) - begin));
    REQUIRE(scene.at("objects").size() == names.size());
    for (std::size_t i = 0; i < names.size(); ++i) {
        // Messages and programs show control characters as visible characters.
        const bool is_shown_as_it_is = std::ranges::all_of(
            names[i], [](char c) { return static_cast<unsigned char>(c) >= 0x20 && c != 0x7f; });
        const std::string label = scene.at("objects").at(i).at("label");
        constexpr std::size_t k_shown = 36;  // long ones end in "..."
        if (is_shown_as_it_is) CHECK(label.substr(0, k_shown) == names[i].substr(0, k_shown));
        CHECK(label.find('\n') == std::string::npos);
    }
}

TEST_CASE("names: in programs, ASCII names stay, Latin letters are transliterated, and others are _") {
    const fs::path directory = scratch_directory();
    const fs::path scene = write_file(directory / "scene.toml", R"(version = 1
observer = {position = [0, 0, 4], look_at = [0, 0, 0]}
shading = {model = "phong"}
reflection = {model = "phong"}
light = [
    {name = "lamp", type = "point", position = [0, 2, 2]},
    {name = "Wei\u00dfe Lampe", type = "ambient"},
]
object = [
    {name = "Gr\u00f6\u00dfe", type = "cube", size = 0.4},
    {name = "\u0392\u03ac\u03c3\u03b7", type = "cube", size = 0.4, position = [1, 0, 0]},
    {name = "\u0448\u0430\u0440", type = "sphere", radius = 0.3, position = [-1, 0, 0]},
    {name = "\u7403 ball", type = "sphere", radius = 0.3, position = [0, 1, 0]},
]
)");
    for (const std::string& target : {std::string("cpp"), std::string("opengl")}) {
        generate(target, scene, directory / target);
        const std::string source = read_file(directory / target / "scene.cpp");
        for (const std::string& name : {"// lamp\n", "// Weisse Lampe\n", "Groesse", "____", "_ ball"}) {
            INFO(target << ": " << name);
            CHECK(holds(source, name));
        }
        CHECK(std::ranges::all_of(source, [](char c) { return static_cast<unsigned char>(c) < 0x80; }));
    }
}
