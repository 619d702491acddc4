// Words that users know from other programs, and the answers to them.
#include <catch2/catch_test_macros.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "support/command.h"
#include "support/expect.h"
#include "support/folder.h"
#include "support/scene_tables.h"
#include "support/text.h"

namespace {

/// A scene with one more line in one of its tables, which is identified by the preceding text.
std::string scene_with(const std::string& table, const std::string& line) {
    std::string text = k_start + "[room]\nwidth = 20\n" + image_table(8, 8) + k_models + k_light + k_cube +
                       "[object.material]\nks = 0.2\n";
    if (table.empty()) return line + "\n" + text;
    const std::size_t at = text.find(table + "\n") + table.size() + 1;
    return text.insert(at, line + "\n");
}

CommandResult checked(const std::string& text) {
    return run_candela({"check", "-"}, {.input = text, .directory = scratch_directory()});
}

struct Said {
    std::string table, line, hint;
};

}  // namespace

TEST_CASE("a key from another program is answered with the intended one, or its table") {
    for (const Said& said : {
             Said{"", "camera = 1", "the camera is the table [observer]"},
             Said{"", "lights = 1", "write a [[light]] for each"},
             Said{"", "objects = 1", "write an [[object]] for each"},
             Said{"", "material = 1", "[object.material]"},
             Said{"", "ambient = 1", "type = \"ambient\""},
             Said{"", "fov = 40", "'fov' belongs in [observer]"},
             Said{"", "background = [1,2,3]", "'background' belongs in [image]"},
             Said{"", "resolution = [800, 600]", "[image] has width and height"},
             Said{"[observer]", "target = [0,0,0]", "did you mean 'look_at'?"},
             Said{"[observer]", "lookat = [0,0,0]", "did you mean 'look_at'?"},
             Said{"[observer]", "eye = [0,0,0]", "did you mean 'position'?"},
             Said{"[observer]", "pos = [0,0,0]", "did you mean 'position'?"},
             Said{"[observer]", "fovy = 40", "did you mean 'fov'?"},
             Said{"[observer]", "samples = 4", "'samples' belongs in [image]"},
             Said{"[observer]", "lens = 4", "(known: position, look_at, up, projection, fov, height,"},
             Said{"[image]", "size = [8, 8]", "write width and height"},
             Said{"[image]", "spp = 4", "did you mean 'samples'?"},
             Said{"[image]", "fov = 4", "'fov' belongs in [observer]"},
             Said{"[image]", "quality = 4", "(known: width, height, samples, background"},
             Said{"[room]", "size = 4", "(known: height, width, depth)"},
             Said{"[[light]]", "pos = [0,0,0]", "did you mean 'position'?"},
             Said{"[[light]]", "power = 4", "did you mean 'intensity'?"},
             Said{"[[light]]", "colour = [1,2,3]", "did you mean 'color'?"},
             Said{"[[object]]", "texture = \"a.png\"", "write color = { texture = "},
             Said{"[[object]]", "normal_texture = \"a.png\"", "did you mean 'normal_map'?"},
             Said{"[object.material]", "normal_map = \"a.png\"",
                  "it belongs in [[object]], such as normal_map"},
             Said{"[[object]]", "diffuse = 0.5", "'kd' in [object.material]"},
             Said{"[[object]]", "specular = 0.5", "ks in [object.material]"},
             Said{"[[object]]", "ka = 0.5", "'ka' belongs in [object.material]"},
             Said{"[[object]]", "kd = 0.5", "'kd' belongs in [object.material]"},
             Said{"[[object]]", "shininess = 5", "'shininess' belongs in [object.material]"},
             Said{"[[object]]", "roughness = 0.5", "'roughness' belongs in [object.material]"},
             Said{"[[object]]", "radius = 1", "an object's size is its 'scale'"},
             Said{"[[object]]", "translate = [0,0,0]", "did you mean 'position'?"},
             Said{"[object.material]", "color = [1,2,3]", "'color' belongs in [[object]]"},
             Said{"[object.material]", "color_texture = \"a.png\"", "the colour is the object's: color = {"},
             Said{"[object.material]", "position = [0,0,0]", "'position' belongs in [[object]]"},
             Said{"[object.material]", "reflection = \"ggx\"", "'reflection' belongs in [[object]]"},
             Said{"[object.material]", "diffuse = 0.5", "did you mean 'kd'?"},
             Said{"[object.material]", "specular = 0.5", "did you mean 'ks'?"},
             Said{"[object.material]", "roughness = 0.5", "has no parameter 'roughness', which"},
         }) {
        const CommandResult result = checked(scene_with(said.table, said.line));
        INFO(said.table << ' ' << said.line << ": " << result.err);
        CHECK(result.exit_code == 3);
        CHECK(holds(result.err, said.hint));
    }
}

TEST_CASE("a colour in another notation is answered with its three integers") {
    for (const Said& said :
         {Said{"[[object]]", "color = [0.5, 0.2, 0.1]", "did you mean [128, 51, 26]?"},
          Said{"[[object]]", "color = [1.0, 0.0, 0.0]", "did you mean [255, 0, 0]?"},
          Said{"[[object]]", "color = [255.0, 128.0, 0.0]", "did you mean [255, 128, 0]?"},
          Said{"[[object]]", "color = [0.5, 0.2, 0.1, 1.0]", "did you mean [128, 51, 26]?"},
          Said{"[[object]]", "color = 128", "did you mean [128, 128, 128]?"},
          Said{"[[object]]", "color = \"#ff8000\"", "write [255, 128, 0]"},
          Said{"[[object]]", "color = \"#f80\"", "write [255, 136, 0]"},
          Said{"[[object]]", "color = \"red\"", "write [255, 0, 0]"},
          Said{"[[object]]", "color = \"crimsonish\"", "write three integers 0 to 255"},
          Said{"[[light]]", "color = [1.0, 0.9, 0.8]", "did you mean [255, 230, 204]?"},
          Said{"[image]", "background = \"White\"", "write [255, 255, 255]"}}) {
        const CommandResult result = checked(scene_with(said.table, said.line));
        INFO(said.line << ": " << result.err);
        CHECK(result.exit_code == 3);
        CHECK(holds(result.err, said.hint));
    }
}

TEST_CASE("a colour of zeros and ones causes a warning with its values in 0 to 255") {
    for (const Said& said : {Said{"[[object]]", "color = [1, 1, 1]", "did you mean [255, 255, 255]?"},
                             Said{"[[object]]", "color = [1, 0, 0]", "did you mean [255, 0, 0]?"},
                             Said{"[[light]]", "color = [1, 1, 1]", "did you mean [255, 255, 255]?"},
                             Said{"[image]", "background = [0, 1, 1]", "did you mean [0, 255, 255]?"}}) {
        const CommandResult result = checked(scene_with(said.table, said.line));
        INFO(said.line << ": " << result.err);
        CHECK(result.exit_code == 0);
        CHECK(holds(result.err, "is almost black"));
        CHECK(holds(result.err, said.hint));
    }
    for (const char* const fine : {"color = [0, 0, 0]", "color = [2, 1, 1]", "color = [255, 1, 0]"})
        CHECK_FALSE(holds(checked(scene_with("[[object]]", fine)).err, "almost black"));
    // Values between two keys were written by nobody.
    const CommandResult film =
        expect(checked(scene_with("[[object]]", "color = [2, 2, 2]") +
                       "[animation]\nframes = 4\nfps = 1\n[[animation.track]]\n"
                       "path = \"object.box.color\"\nkeys = [[0, [0, 0, 0]], [3, [3, 3, 3]]]\n"),
               0);
    CHECK_FALSE(holds(film.err, "almost black"));
}

TEST_CASE("the error about a light or an observer inside an object says how to allow it") {
    expect(checked(scene_with("[[object]]", "position = [1, 1, 3]")), 3,
           {"is inside object 'box'", "encloses = true"});
    const CommandResult observer = checked(scene_with("[[object]]", "position = [0, 0, 4]"));
    CHECK(holds(observer.err, "the observer is inside object 'box'"));
    CHECK(holds(observer.err, "encloses = true"));
}

TEST_CASE("options of other programs are answered with those of the verb") {
    struct Typed {
        std::vector<std::string> words;
        std::string hint;
    };
    for (const Typed& typed : {
             Typed{{"render", "--size", "800x600"}, "use --width 800 --height 600"},
             Typed{{"render", "--size=800x600"}, "use --width 800 --height 600"},
             Typed{{"render", "--resolution", "800x600"}, "use --width 800 --height 600"},
             Typed{{"render", "-s", "800x600"}, "use --width 800 --height 600"},
             Typed{{"render", "-w", "800"}, "did you mean '--width'?"},
             Typed{{"render", "-h", "600"}, "did you mean '--height'?"},
             Typed{{"render", "-h600"}, "did you mean '--height'?"},
             Typed{{"render", "-w", "800", "-h", "600"}, "-h means --help"},
             Typed{{"render", "--samples-per-pixel", "4"}, "did you mean '--samples'?"},
             Typed{{"render", "--spp", "4"}, "did you mean '--samples'?"},
             Typed{{"render", "--outptu", "a.png"}, "did you mean '--output'?"},
             Typed{{"render", "--out", "a.png"}, "did you mean '--output'?"},
             Typed{{"render", "--jobs", "4"}, "did you mean '--threads'?"},
             Typed{{"render", "-j4"}, "did you mean '--threads'?"},
             Typed{{"render", "--format", "png"}, "extension"},
         }) {
        const CommandResult result = run_candela(typed.words, {.directory = scratch_directory()});
        INFO(typed.words[1] << ": " << result.err);
        CHECK(result.exit_code == 2);
        CHECK(holds(result.err, typed.hint));
    }
    expect(run_candela({"render", "-h"}), 0);
}

TEST_CASE("quiet may be given twice, by a user and by a program") {
    const Folder d;
    const CommandResult result = expect(d.run("render -o a.png -q --quiet -q"), 0);
    CHECK(result.err.empty());
}

TEST_CASE("the models in the help of candela plot can be plotted as printed") {
    std::string help = run_candela({"plot", "--help"}, {.environment = {{"COLUMNS", "500"}}}).out;
    int plotted = 0;
    for (const std::string kind : {"reflection/", "light/"}) {
        for (std::size_t at = help.find(kind); at != std::string::npos; at = help.find(kind, at + 1)) {
            std::string model = help.substr(at, help.find_first_of(" ),\n", at) - at);
            // A list of values has commas in it; a sentence ends after its last digit.
            if (const auto colon = model.find(':'); colon != std::string::npos)
                model = help.substr(at, help.find(' ', at) - at);
            model.erase(model.find_last_not_of(".,:") + 1);
            const CommandResult result = run_candela({"plot", model});
            INFO(model << ": " << result.err);
            CHECK(result.exit_code == 0);
            ++plotted;
        }
    }
    CHECK(plotted >= 3);
}
