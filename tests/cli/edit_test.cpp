// candela edit: what it writes, and what it says where it writes nothing.
#include <catch2/catch_test_macros.hpp>
#include <filesystem>
#include <iterator>
#include <string>
#include <vector>

#include "support/command.h"

namespace fs = std::filesystem;

namespace {

const std::string k_scene =
    "# Mine.\nversion = 1\n[observer]\nposition = [0, 0, 4] # metres\nlook_at = [0, 0, 0]\n"
    "[shading]\nmodel = \"phong\"\n[reflection]\nmodel = \"phong\"\n"
    "[[light]]\nname = \"key\"\ntype = \"point\"\nposition = [1, 1, 3]\n"
    "[[object]]\ntype = \"sphere\"\nradius = 0.5\n";

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

struct Edited {
    CommandResult result;
    std::string text;
};

Edited edit(const std::vector<std::string>& options) {
    const fs::path folder = scratch_directory();
    const fs::path file = write_file(folder / "scene.toml", k_scene);
    std::vector<std::string> words{"edit", "scene.toml"};
    words.insert(words.end(), options.begin(), options.end());
    Edited edited{run_candela(words, {.input = "", .environment = {}, .directory = folder}), {}};
    edited.text = read_file(file);
    // Neither a draft nor anything else is left beside the scene.
    CHECK(std::distance(fs::directory_iterator(folder), fs::directory_iterator()) == 1);
    return edited;
}

}  // namespace

TEST_CASE("candela edit writes values into the file, and says its name") {
    const Edited edited = edit({"--change", "light.key.intensity=0.5", "--change=observer.position=[0,1,4]"});
    CHECK(edited.result.exit_code == 0);
    CHECK(edited.result.err == "scene.toml: changed\n");
    CHECK(edited.text ==
          "# Mine.\nversion = 1\n[observer]\nposition = [0, 1, 4] # metres\nlook_at = [0, 0, 0]\n"
          "[shading]\nmodel = \"phong\"\n[reflection]\nmodel = \"phong\"\n"
          "[[light]]\nname = \"key\"\ntype = \"point\"\nposition = [1, 1, 3]\nintensity = 0.5\n"
          "[[object]]\ntype = \"sphere\"\nradius = 0.5\n");
}

TEST_CASE("candela edit writes nothing, and says why, if the scene would have errors") {
    struct Wrong {
        std::vector<std::string> options;
        int exit_code;
        const char* message;
    };
    for (const Wrong& wrong : {
             Wrong{{"--change", "light.kye.intensity=1"}, 3, "no light is called 'kye'"},
             Wrong{{"--change", "light.key.intensity=-1"}, 3, "intensity"},
             Wrong{{"--change", "shading.model=gourad"}, 3, "gouraud"},
             // Only the triangles tell.
             Wrong{{"--change", "light.key.position=[0,0,0]"}, 3, "is inside object"},
             Wrong{{"--change", "width"}, 2, "has no '='"},
             Wrong{{}, 2, "nothing is to be changed"},
             Wrong{{"--change", "light.key.intensity=2", "--set", "light.key.intensity=3"}, 2, "prevails"},
         }) {
        const Edited edited = edit(wrong.options);
        INFO(edited.result.err);
        CHECK(edited.result.exit_code == wrong.exit_code);
        CHECK(holds(edited.result.err, wrong.message));
        CHECK(edited.result.out.empty());
        CHECK(edited.text == k_scene);
    }
}

TEST_CASE("candela edit needs a file to write into") {
    CHECK(run_candela({"edit", "--change", "image.width=9"}).exit_code == 2);
    const CommandResult piped = run_candela({"edit", "-", "--change", "image.width=9"},
                                            {.input = k_scene, .environment = {}, .directory = {}});
    CHECK(piped.exit_code == 2);
    CHECK(holds(piped.err, "pipe"));
    CHECK(run_candela({"edit", "missing.toml", "--change", "image.width=9"}).exit_code != 0);
}

TEST_CASE(
    "candela edit changes the first line of a file that begins with a byte order mark, and keeps the mark") {
    const fs::path folder = scratch_directory();
    const std::string mark = "\xef\xbb\xbf";
    const fs::path file =
        write_file(folder / "scene.toml", mark + "image = { width = 100, height = 50 }\n" + k_scene);
    const CommandResult result =
        run_candela({"edit", "scene.toml", "--change", "image.width=200", "--change", "image.samples=4"},
                    {.input = "", .environment = {}, .directory = folder});
    INFO(result.err);
    CHECK(result.exit_code == 0);
    CHECK(read_file(file) == mark + "image = { width = 200, height = 50, samples = 4 }\n" + k_scene);
}
