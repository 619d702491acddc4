// Breaks every constraint, every type and every boundary of the scene file, one at a time, in a valid scene,
// and runs the built command on it.
#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "support/command.h"
#include "support/expect.h"
#include "support/folder.h"
#include "support/text.h"
#include "support/valid_scene.h"

namespace {

/// One place in the valid scene, and its replacement. An @ is not part of the text: it marks the place that
/// the message must point to.
struct Change {
    const char* from;
    const char* to;
};

struct Mistake {
    Change change;
    std::vector<const char*> message;  // parts of the message and its hint
};

struct Spoilt {
    std::string text;
    std::string place;  // of the mark, "14:9"; empty without one
};

Spoilt spoilt(const Change& change) {
    Spoilt result{k_valid_scene, {}};
    const std::size_t at = result.text.find(change.from);
    INFO(change.from);
    REQUIRE(at != std::string::npos);
    result.text.replace(at, std::string(change.from).size(), change.to);
    const std::size_t mark = result.text.find('@');
    if (mark == std::string::npos) return result;
    result.text.erase(mark, 1);
    const std::size_t line_begin = mark == 0 ? 0 : result.text.rfind('\n', mark - 1) + 1;
    const auto line =
        1 + std::count(result.text.begin(), result.text.begin() + static_cast<std::ptrdiff_t>(mark), '\n');
    result.place = std::to_string(line) + ":" + std::to_string(mark - line_begin + 1);
    return result;
}

CommandResult checked(const std::string& text) {
    const Folder directory;
    directory.write("wedge.obj", k_valid_mesh);
    directory.write("scene.toml", text);
    return directory.run("check scene.toml");
}

/// Expects an error for each mistake, at its place and with its message, and no others.
void check_mistakes(const std::vector<Mistake>& mistakes) {
    for (const Mistake& mistake : mistakes) {
        const Spoilt scene = spoilt(mistake.change);
        const CommandResult result = checked(scene.text);
        INFO(mistake.change.to << "\n" << result.err);
        CHECK(result.exit_code == 3);
        CHECK(result.out.empty());
        CHECK(count_of(result.err, " error: ") == 1);
        CHECK(holds(result.err, "scene.toml:" + scene.place + ": error: "));
        for (const char* const part : mistake.message) {
            INFO(part);
            CHECK(holds(result.err, part));
        }
    }
}

void check_good(const std::vector<Change>& changes, const char* warning = nullptr) {
    for (const Change& change : changes) {
        const CommandResult result = checked(spoilt(change).text);
        INFO(change.to << "\n" << result.err);
        CHECK(result.exit_code == 0);
        CHECK(count_of(result.err, "error") == 0);
        if (warning == nullptr) {
            CHECK(result.err.empty());
        } else {
            CHECK(holds(result.err, warning));
        }
    }
}

}  // namespace

TEST_CASE("the scene that the mistakes are made in is valid") { check_good({{"", ""}}); }

TEST_CASE("mistakes of the version") {
    check_mistakes({
        {{"version = 1", "version = @2"}, {"does not support version 2 of the scene file", "version 1"}},
        {{"version = 1", "version = @1.0"}, {"'version' is the number 1", "integer 1"}},
        {{"version = 1", "version = @\"1\""}, {"a string, \"1\""}},
        {{"version = 1", "version = 1\n@verison = 1"}, {"unknown key 'verison'", "did you mean 'version'?"}},
    });
    expect(checked(spoilt({"version = 1", ""}).text), 3, {"scene.toml: error: the scene has no version"});
}

TEST_CASE("mistakes of the room") {
    check_mistakes({
        {{"width  = 10.0", "width  = @0"}, {"'width': 0 is outside its range: greater than 0"}},
        {{"width  = 10.0", "width  = @-10"}, {"-10 is outside its range"}},
        {{"height = 8.0", "height = @nan"}, {"nan is not a usable number"}},
        {{"depth  = 12.0", "depth  = @inf"}, {"inf is not a usable number"}},
        {{"depth  = 12.0", "depth  = @1e39"}, {"too large (at most 3.4"}},
        {{"width  = 10.0", "width  = @\"wide\""},
         {"'width' is a string, \"wide\"", "expected a number, greater than 0"}},
        {{"width  = 10.0", "width  = @[10.0]"}, {"a list of 1 value"}},
        {{"width  = 10.0", "width  = @true"}, {"'width' is true", "expected a number"}},
        {{"width  = 10.0", "width  = @1979-05-27"}, {"a date or time"}},
        {{"width  = 10.0", "width  = @{ metres = 10 }"}, {"'width' is a table"}},
        {{"width  = 10.0", "@widht  = 10.0"}, {"unknown key 'widht' in [room]", "did you mean 'width'?"}},
        {{"[room]", "[@romo]"}, {"unknown key 'romo' in the scene", "did you mean 'room'?"}},
        {{"[room]", "[[@room]]"}, {"'room' is a list: there may be only one"}},
    });
    check_good({{"width  = 10.0", "width  = 9"}, {"width  = 10.0", "width  = 1e30"}});
}

TEST_CASE("mistakes of the observer") {
    check_mistakes({
        {{"position   = [0.0, 0.5, 5.0]", "position   = @[0.0, 0.5]"},
         {"a list of 2 values", "expected three numbers, a position in metres"}},
        {{"position   = [0.0, 0.5, 5.0]", "position   = @[0.0, 0.5, \"near\"]"},
         {"a list whose third value is a string, \"near\""}},
        {{"position   = [0.0, 0.5, 5.0]", "position   = @[0.0, nan, 5.0]"}, {"nan is not a usable number"}},
        {{"position   = [0.0, 0.5, 5.0]", "position   = @[-inf, 0.5, 5.0]"}, {"-inf is not a usable number"}},
        {{"position   = [0.0, 0.5, 5.0]", "position   = @5.0"}, {"'position' is the number 5"}},
        {{"position   = [0.0, 0.5, 5.0]", "position   = @[0.0, 0.5, 6.001]"},
         {"the observer is not inside the room: its z is 6.001", "from z = -6 to z = 6"}},
        {{"position   = [0.0, 0.5, 5.0]", "position   = @[-2.0, 0.1, 0.1]"},
         {"the observer is inside object 'box'", "scene.toml:56:1"}},
        {{"position   = [0.0, 0.5, 5.0]", "position   = @[2.8, 0.25, 0.0]"},
         {"the observer is inside object 'ring'"}},
        {{"look_at    = [0.0, 0.0, 0.0]", "look_at    = @[0.0, 0.5, 5.0]"},
         {"the observer is at the point it looks at", "must differ"}},
        {{"look_at    = [0.0, 0.0, 0.0]", "look_at    = @\"box\""}, {"'look_at' is a string, \"box\""}},
        {{"up         = [0.0, 1.0, 0.0]", "up         = @[0, 0.1, 1.0]"},
         {"'up' is parallel to the viewing direction"}},
        {{"up         = [0.0, 1.0, 0.0]", "up         = @[0, -0.5, -5.0]"},
         {"'up' is parallel to the viewing direction"}},
        {{"up         = [0.0, 1.0, 0.0]", "up         = @[0, 0, 0]"}, {"'up': a direction cannot be zero"}},
        {{"projection = \"perspective\"", "projection = @\"fisheye\""},
         {"\"fisheye\" is not one of 'perspective', 'orthographic'"}},
        {{"projection = \"perspective\"", "projection = @\"perspectiv\""}, {"did you mean 'perspective'?"}},
        {{"projection = \"perspective\"", "projection = @1"}, {"the integer 1"}},
        {{"fov        = 40.0", "fov        = @0"},
         {"'fov': 0 is outside its range: greater than 0 and less than 180"}},
        {{"fov        = 40.0", "fov        = @180"}, {"180 is outside its range"}},
        {{"fov        = 40.0", "fov        = @-40"}, {"-40 is outside its range"}},
        {{"fov        = 40.0", "fov        = @\"40\""}, {"'fov' is a string, \"40\""}},
        {{"projection = \"perspective\"\nfov        = 40.0", "projection = \"orthographic\"\nheight = @0"},
         {"'height': 0 is outside its range"}},
        {{"fov        = 40.0", "@fovy       = 40.0"},
         {"unknown key 'fovy' in [observer]", "did you mean 'fov'?"}},
        {{"[observer]\nposition   = [0.0, 0.5, 5.0]\n", "[@observer]\n"},
         {"[observer] has no 'position': three numbers, a position in metres"}},
    });
    check_good({{"fov        = 40.0", "fov        = 0.001"},
                {"fov        = 40.0", "fov        = 179.9"},
                {"position   = [0.0, 0.5, 5.0]", "position   = [0.0, 0.5, 6.0]"},
                {"position   = [0.0, 0.5, 5.0]", "position   = [2.0, 0.25, 0.1]"},
                {"position   = [0.0, 0.5, 5.0]", "position   = [0, 1, 5]"},
                {"projection = \"perspective\"\nfov        = 40.0",
                 "projection = \"orthographic\"\nheight = 0.01"}});
    check_good({{"projection = \"perspective\"", "projection = \"orthographic\""}},
               "warning: 'fov' has no effect in an orthographic view");
    expect(
        checked(spoilt({"[observer]\nposition   = [0.0, 0.5, 5.0]\nlook_at    = [0.0, 0.0, 0.0]\nup         "
                        "= [0.0, 1.0, 0.0]\nprojection = \"perspective\"\nfov        = 40.0\n",
                        ""})
                    .text),
        3, {"scene.toml: error: the scene has no [observer]"});
}

TEST_CASE("mistakes of the image") {
    check_mistakes({
        {{"width      = 64", "width      = @0"}, {"'width': 0 is outside its range: 1 to 65536"}},
        {{"width      = 64", "width      = @65537"}, {"65537 is outside its range"}},
        {{"width      = 64", "width      = @-64"}, {"-64 is outside its range"}},
        {{"width      = 64", "width      = @64.0"},
         {"'width' is the number 64", "expected an integer, 1 to 65536"}},
        {{"height     = 48", "height     = @99999999999"}, {"99999999999", "1 to 65536"}},
        {{"height     = 48", "height     = @\"48\""}, {"'height' is a string, \"48\""}},
        {{"samples    = 4", "samples    = @2"}, {"'samples': 2 is not one of 1, 4, 8, 16"}},
        {{"samples    = 4", "samples    = @0"}, {"0 is not one of 1, 4, 8, 16"}},
        {{"samples    = 4", "samples    = @4.0"}, {"the number 4", "expected one of 1, 4, 8, 16"}},
        {{"background = [10, 20, 30]", "background = @[10, 20, 257]"},
         {"'background': [10, 20, 257] is outside its range: 0 to 255"}},
        {{"background = [10, 20, 30]", "background = @[-1, 20, 30]"}, {"outside its range: 0 to 255"}},
        {{"background = [10, 20, 30]", "background = @[10, 20.5, 30]"},
         {"a list whose second value is the number 20.5", "expected three integers 0-255"}},
        {{"background = [10, 20, 30]", "background = @[10, 20, 30, 255]"}, {"a list of 4 values"}},
        {{"background = [10, 20, 30]", "background = @\"black\""},
         {"a string, \"black\"; expected three integers 0-255"}},
        {{"background = [10, 20, 30]", "background = @0x102030"}, {"the integer 0x102030"}},
        {{"color_management = \"srgb\"", "color_management = @\"SRGB\""},
         {"\"SRGB\" is not one of 'srgb', 'none'", "did you mean 'srgb'?"}},
        {{"color_management = \"srgb\"", "color_management = @false"}, {"'color_management' is false"}},
        {{"samples    = 4", "@sample     = 4"},
         {"unknown key 'sample' in [image]", "did you mean 'samples'?"}},
    });
    check_good({{"width      = 64", "width      = 1"},
                {"width      = 64", "width      = 65536"},
                {"samples    = 4", "samples    = 1"},
                {"samples    = 4", "samples    = 8"},
                {"samples    = 4", "samples    = 16"},
                {"background = [10, 20, 30]", "background = [0, 0, 255]"},
                {"color_management = \"srgb\"", "color_management = \"none\""}});
    check_good({{"background = [10, 20, 30]", "background = [0, 0, 256]"}}, "256 counts as 255");
}

TEST_CASE("mistakes of the models") {
    check_mistakes({
        {{"[shading]\nmodel = \"phong\"", "[shading]\nmodel = @\"pohng\""},
         {"'pohng'", "did you mean 'phong'?"}},
        {{"[shading]\nmodel = \"phong\"", "[shading]\nmodel = @\"blinn-phong\""}, {"'blinn-phong'"}},
        {{"[shading]\nmodel = \"phong\"", "[shading]\nmodel = @\"\""}, {"shading"}},
        {{"[shading]\nmodel = \"phong\"", "[shading]\nmodel = @3"},
         {"'model' is the integer 3", "expected a quoted string"}},
        {{"[shading]\nmodel = \"phong\"", "[shading]\nmodel = \"phong\"\n@smooth = true"},
         {"unknown key 'smooth' in [shading]"}},
        {{"[shading]\nmodel = \"phong\"", "[@shading]"}, {"[shading] has no 'model'"}},
        {{"[reflection]\nmodel = \"phong\"", "[reflection]\nmodel = @\"lambrt\""},
         {"did you mean 'lambert'?"}},
        {{"[reflection]\nmodel = \"phong\"", "[reflection]\nmodel = @[\"phong\"]"}, {"a list of 1 value"}},
        {{"[reflection]\nmodel = \"phong\"", "[reflection]\nmodel = \"phong\"\n@kd = 0.5"},
         {"unknown key 'kd' in [reflection]", "[object.material]"}},
        {{"[reflection]\nmodel = \"phong\"", "[@reflection]"}, {"[reflection] has no 'model'"}},
        {{"shading    = \"flat\"", "shading    = @\"flatt\""}, {"did you mean 'flat'?"}},
        {{"reflection = \"blinn-phong\"", "reflection = @\"blinn\""}, {"'blinn'"}},
        {{"reflection = \"blinn-phong\"", "reflection = @true"}, {"'reflection' is true"}},
        {{"reflection = \"blinn-phong\"\n\n[object.material]\nka = 0.1\nkd = 0.7\nks = [0.3, 0.2, "
          "0.1]\nshininess = 31.0",
          "reflection = \"lambert\"\n[object.material]\nkd = 0.7\n@shininess = 31.0"},
         {"reflection/lambert has no parameter 'shininess', which reflection/blinn-phong, "}},
    });
    // R12, R13: there is nobody to ask.
    for (const auto& [change, what] : std::vector<std::pair<Change, const char*>>{
             {{"[shading]\nmodel = \"phong\"", ""}, "the scene names no shading model"},
             {{"[reflection]\nmodel = \"phong\"", ""}, "the scene names no reflection model"}}) {
        expect(checked(spoilt(change).text), 3, {what, "--defaults"});
    }
    check_good({{"[shading]\nmodel = \"phong\"", "[shading]\nmodel = \"gouraud\""},
                {"reflection = \"blinn-phong\"", "reflection = \"phong\""}});
}

TEST_CASE("mistakes of lights") {
    check_mistakes({
        {{"type      = \"point\"", "type      = @\"piont\""}, {"did you mean 'point'?"}},
        {{"type      = \"point\"", "type      = @\"sphere\""}, {"'sphere'"}},
        {{"[[light]]\nname      = \"lamp\"\ntype      = \"point\"", "@[[light]]\nname      = \"lamp\""},
         {"[[light]] 'lamp' has no 'type'"}},
        {{"color     = [250, 240, 230]", "color     = @[250, 240, 257]"},
         {"'color': [250, 240, 257] is outside its range: 0 to 255"}},
        {{"color     = [250, 240, 230]", "color     = @[250, -1, 230]"}, {"outside its range"}},
        {{"color     = [250, 240, 230]", "color     = @\"red\""},
         {"'color' is a string, \"red\"; expected three integers 0-255"}},
        {{"color     = [250, 240, 230]", "color     = @[1.0, 1.0, 1.0]"},
         {"a list whose first value is the number 1"}},
        {{"intensity = 20.0", "intensity = @-0.001"},
         {"'intensity': -0.001 is outside its range: at least 0"}},
        {{"intensity = 20.0", "intensity = @\"bright\""}, {"'intensity' is a string"}},
        {{"intensity = 20.0", "intensity = @inf"}, {"not a usable number"}},
        {{"intensity = 20.0", "@intesity = 20.0"},
         {"unknown key 'intesity' in [[light]] 'lamp'", "did you mean 'intensity'?",
          "candela describe light/point"}},
        {{"position  = [1.0, 2.0, 3.0]", "position  = @[5.01, 2.0, 3.0]"},
         {"light 'lamp' is not inside the room: its x is 5.01", "from x = -5 to x = 5"}},
        {{"position  = [1.0, 2.0, 3.0]", "position  = @[1.0, 2.0, -6.5]"}, {"its z is -6.5"}},
        {{"position  = [1.0, 2.0, 3.0]", "position  = @[0.0, -1.0, 0.1]"},
         {"light 'lamp' is inside object 'ball'"}},
        {{"position  = [1.0, 2.0, 3.0]", "position  = @[0.1, 1.1, -2.9]"},
         {"light 'lamp' is inside object 'wedge'"}},
        {{"position  = [1.0, 2.0, 3.0]", "position  = @[0.0, 0.5, 5.0]"},
         {"light 'lamp' is where the observer is", "scene.toml:9:14"}},
        {{"position    = [0.0, 3.5, 0.25]", "position    = @[1.0, 2.0, 3.0]"},
         {"light 'beam' is at the same place as light 'lamp'", "scene.toml:33:13"}},
        {{"[[light]]\nname      = \"sun\"\ntype      = \"directional\"\ndirection = [0, -1, -1]",
          "@[[light]]\nname = \"sun\"\ntype = \"directional\""},
         {"[[light]] 'sun' has no 'direction'"}},
        {{"attenuation        = \"offset-linear\"", "attenuation        = @\"inverse_square\""},
         {"did you mean 'inverse-square'?"}},
        {{"attenuation_offset = 0.5", "attenuation_offset = @-0.5"},
         {"-0.5 is outside its range: at least 0"}},
        {{"direction   = [0.0, -1.0, 0.0]", "direction   = @[0.0, 0.0, 0.0]"},
         {"'direction': a direction cannot be zero"}},
        {{"direction   = [0.0, -1.0, 0.0]", "direction   = @-1.0"}, {"expected three numbers, not all zero"}},
        {{"inner_angle = 15.0", "inner_angle = @35.001"},
         {"inner_angle (35.001) must not exceed outer_angle (35)"}},
        {{"inner_angle = 15.0", "inner_angle = @-1"},
         {"-1 is outside its range: at least 0 and less than 90"}},
        {{"outer_angle = 35.0", "outer_angle = @90"}, {"90 is outside its range"}},
        {{"falloff     = \"linear\"", "falloff     = @\"cubic\""}, {"one of 'smoothstep', 'linear'"}},
        {{"direction = [0, -1, -1]", "direction = [0, -1, -1]\n@position = [0, 0, 0]"},
         {"unknown key 'position' in [[light]] 'sun'"}},
        {{"name      = \"sun\"", "name      = @\"lamp\""},
         {"another light is called 'lamp'", "scene.toml:29:13"}},
        {{"name      = \"sun\"", "name      = @5"}, {"'name' is the integer 5"}},
        {{"[[light]]\nname  = \"sky\"", "[[@lights]]\nname  = \"sky\""},
         {"unknown key 'lights' in the scene", "write a [[light]] for each"}},
    });
    check_good({{"color     = [250, 240, 230]", "color     = [0, 0, 0]"},
                {"intensity = 20.0", "intensity = 0"},
                {"position  = [1.0, 2.0, 3.0]", "position  = [5.0, 4.0, -6.0]"},
                {"position  = [1.0, 2.0, 3.0]", "position  = [2.0, 0.25, 0.0]"},
                {"position  = [1.0, 2.0, 3.0]", "position  = [0.0, -0.24, 0.0]"},
                {"attenuation_offset = 0.5", "attenuation_offset = 0"},
                {"inner_angle = 15.0", "inner_angle = 35.0"},
                {"inner_angle = 15.0", "inner_angle = 0"},
                {"outer_angle = 35.0", "outer_angle = 89.99"},
                {"name      = \"sun\"", ""},
                {"name      = \"sun\"", "name      = \"box\""}});
    check_good({{"color     = [250, 240, 230]", "color     = [256, 240, 230]"}},
               "'color': 256 counts as 255");
}

TEST_CASE("mistakes of objects") {
    check_mistakes({
        {{"type     = \"cube\"", "type     = @\"qube\""}, {"did you mean 'cube'?"}},
        {{"type     = \"cube\"", "type     = @\"point\""}, {"'point'"}},
        {{"size     = 1.5", "size     = @0.0"}, {"'size': 0.0 is outside its range: greater than 0"}},
        {{"size     = 1.5", "size     = @-1.5"}, {"-1.5 is outside its range"}},
        {{"size     = 1.5", "size     = @[1, 1, 1]"},
         {"'size' is a list of 3 values; expected a number, greater than 0"}},
        {{"size     = 1.5", "@radius   = 1.5"},
         {"unknown key 'radius' in [[object]] 'box'", "candela describe shape/cube"}},
        {{"position = [-2.0, 0.0, 0.0]", "position = @[-2.0, 0.0]"}, {"a list of 2 values"}},
        {{"rotation = [0.0, 30.0, 0.0]", "rotation = @30.0"},
         {"'rotation' is the number 30", "expected three numbers"}},
        {{"rotation = [0.0, 30.0, 0.0]", "rotation = @[0.0, inf, 0.0]"}, {"inf is not a usable number"}},
        {{"scale    = [1.0, 0.5, 1.0]", "scale    = @0"}, {"'scale'", "outside its range: greater than 0"}},
        {{"scale    = [1.0, 0.5, 1.0]", "scale    = @[1.0, 0.0, 1.0]"},
         {"outside its range: greater than 0"}},
        {{"scale    = [1.0, 0.5, 1.0]", "scale    = @[1.0, -0.5, 1.0]"}, {"outside its range"}},
        {{"scale    = [1.0, 0.5, 1.0]", "scale    = @[1.0, 0.5]"},
         {"a list of 2 values; expected a number, or three of them"}},
        {{"color    = [200, 60, 40]", "color    = @[200, 60, 257]"}, {"outside its range: 0 to 255"}},
        {{"color    = [200, 60, 40]", "color    = @[200, 60]"}, {"a list of 2 values"}},
        {{"color    = [200, 60, 40]", "color    = @\"#c83c28\""}, {"a string, \"#c83c28\""}},
        {{"color    = [200, 60, 40]", "@colour   = [200, 60, 40]"},
         {"unknown key 'colour'", "did you mean 'color'?"}},
        {{"name     = \"ball\"", "name     = @\"box\""},
         {"another object is called 'box'", "scene.toml:57:12"}},
        {{"radius   = 0.75", "radius   = @0"}, {"'radius': 0 is outside its range"}},
        {{"segments = 20", "segments = @2"}, {"'segments': 2 is outside its range: 3 to 8192"}},
        {{"segments = 20", "segments = @8193"}, {"8193 is outside its range"}},
        {{"segments = 20", "segments = @20.0"}, {"'segments' is the number 20", "expected an integer"}},
        {{"minor_radius = 0.3", "minor_radius = @0.8"},
         {"minor_radius (0.8) must be less than major_radius (0.8): the tube would run into itself"}},
        {{"minor_radius = 0.3", "minor_radius = @0"}, {"'minor_radius': 0 is outside its range"}},
        {{"file = \"wedge.obj\"", "file = @\"wedg.obj\""},
         {"'wedg.obj' does not exist", "did you mean 'wedge.obj'?"}},
        {{"file = \"wedge.obj\"", "file = @\"none/wedge.obj\""}, {"does not exist", "no folder 'none'"}},
        {{"file = \"wedge.obj\"", "file = @\".\""}, {"'.' is a directory, not a file"}},
        {{"file = \"wedge.obj\"", "file = @\"/dev/null\""}, {"is not a regular file"}},
        {{"file = \"wedge.obj\"", "file = @3"}, {"'file' is the integer 3", "expected a quoted path"}},
        {{"[[object]]\nname = \"ring\"\ntype = \"torus\"", "@[[object]]\nname = \"ring\""},
         {"[[object]] 'ring' has no 'type'"}},
        {{"[object.material]\nka = 0.1\nkd = 0.7\nks = [0.3, 0.2, 0.1]\nshininess = 31.0",
          "material = @\"shiny\""},
         {"'material' is a string, \"shiny\"; expected the table [object.material]"}},
    });
    check_good({{"size     = 1.5", "size     = 2"},
                {"rotation = [0.0, 30.0, 0.0]", "rotation = [0.0, 3000, -1]"},
                {"scale    = [1.0, 0.5, 1.0]", "scale    = 1"},
                {"segments = 20", "segments = 3"},
                {"minor_radius = 0.3", "minor_radius = 0.79"},
                {"name     = \"ball\"", ""}});
}

TEST_CASE("mistakes of materials") {
    check_mistakes({
        {{"ka = 0.1", "ka = @1.001"}, {"'ka'", "1.001", "outside its range: 0 to 1"}},
        {{"ka = 0.1", "ka = @-0.1"}, {"outside its range: 0 to 1"}},
        {{"kd = 0.7", "kd = @1.5"}, {"'kd'", "outside its range: 0 to 1"}},
        {{"kd = 0.7", "kd = @\"high\""},
         {"'kd' is a string, \"high\"; expected a number, or three of them, 0 to 1"}},
        {{"ks = [0.3, 0.2, 0.1]", "ks = @[0.3, 0.2, 1.1]"}, {"'ks': [0.3, 0.2, 1.1] is outside its range"}},
        {{"ks = [0.3, 0.2, 0.1]", "ks = @[0.3, 0.2]"}, {"a list of 2 values"}},
        {{"ks = [0.3, 0.2, 0.1]", "ks = @[0.3, 0.2, false]"}, {"a list whose third value is false"}},
        {{"shininess = 31.0", "shininess = @-1"}, {"'shininess': -1 is outside its range: at least 0"}},
        {{"shininess = 31.0", "shininess = @nan"}, {"nan is not a usable number"}},
        {{"shininess = 31.0", "@shinyness = 31.0"},
         {"unknown key 'shinyness' in [object.material] of 'box'",
          "did you mean 'shininess'?  (candela describe reflection/blinn-phong)"}},
        {{"ka = 0.1", "@exponent = 2\nka = 0.1"},
         {"reflection/blinn-phong has no parameter 'exponent', which reflection/half-lambert has"}},
    });
    check_good({{"ka = 0.1", "ka = 0"},
                {"ka = 0.1", "ka = 1"},
                {"ka = 0.1", "ka = [0, 0.5, 1]"},
                {"shininess = 31.0", "shininess = 0"},
                {"shininess = 31.0", "shininess = 1000000"},
                {"kd = 0.7", "kd = 0"}});
    check_good({{"kd = 0.7", "kd = 0.75"}}, "more than 1: the surface sends out more light than it receives");
}

TEST_CASE("objects that leave the room or overlap") {
    check_mistakes({
        {{"position = [-2.0, 0.0, 0.0]", "position = @[-4.0, 0.0, 0.0]"},
         {"object 'box' is not wholly inside the room: it reaches from x = -5.02452 to x = -2.97548",
          "from x = -5 to x = 5"}},
        {{"position = [0.0, -1.0, 0.0]", "position = @[0.0, -3.26, 0.0]"},
         {"it reaches from y = -4.01 to y = -2.51"}},
        {{"position     = [2.0, 0.25, 0.0]", "position     = @[2.0, 0.25, 4.91]"},
         {"object 'ring' is not wholly inside the room"}},
        {{"position = [0.0, 1.0, -3.0]", "position = @[0.0, 3.01, -3.0]"},
         {"object 'wedge' is not wholly inside the room: it reaches from y = 3.01 to y = 4.01"}},
        {{"position = [0.0, -1.0, 0.0]", "position = @[-1.6, 0.0, 0.0]"},
         {"object 'ball' overlaps object 'box'", "scene.toml:60:12"}},
        {{"position     = [2.0, 0.25, 0.0]", "position     = @[0.8, -0.9, 0.0]"},
         {"object 'ring' overlaps object 'ball'"}},
        {{"radius   = 0.75\nsegments = 20\nposition = [0.0, -1.0, 0.0]",
          "radius   = 0.1\nsegments = 20\nposition = @[-2.0, 0.0, 0.0]"},
         {"object 'ball' overlaps object 'box'"}},
        {{"position = [0.0, 1.0, -3.0]", "position = @[2.7, 0.25, 0.0]"},
         {"object 'wedge' overlaps object 'ring'"}},
    });
    // Neighbours: on the floor, in the ring's hole, and with overlapping boxes but disjoint surfaces.
    check_good({{"position = [0.0, -1.0, 0.0]", "position = [0.0, -3.25, 0.0]"},
                {"radius   = 0.75\nsegments = 20\nposition = [0.0, -1.0, 0.0]",
                 "radius   = 0.45\nsegments = 20\nposition = [2.0, 0.25, 0.0]"},
                {"position     = [2.0, 0.25, 0.0]", "position     = [2.0, 0.25, 4.9]"},
                {"position = [0.0, 1.0, -3.0]", "position = [0.0, 3.0, -3.0]"}});
}

TEST_CASE("a mistake in every table is found in one run, sorted by place, geometry with the rest") {
    std::string text = spoilt({"shininess = 31.0", "shinyness = 31.0"}).text;
    const auto replace = [&](const std::string& from, const std::string& to) {
        const std::size_t at = text.find(from);
        REQUIRE(at != std::string::npos);
        text.replace(at, from.size(), to);
    };
    replace("width  = 10.0", "width  = \"ten\"");
    replace("fov        = 40.0", "fov        = 200");
    replace("samples    = 4", "samples    = 3");
    replace("type      = \"point\"", "type      = \"poynt\"");
    replace("position    = [0.0, 3.5, 0.25]", "position    = [0.0, -1.0, 0.25]");
    replace("position = [0.0, 1.0, -3.0]", "position = [2.7, 0.25, 0.0]");
    const CommandResult result = expect(checked(text), 3);
    std::size_t before = 0;
    for (const char* const part :
         {":4:10: error: 'width'", ":13:14: error: 'fov'", ":18:14: error: 'samples'",
          ":30:13: error:", ":40:15: error: light 'beam' is inside object 'ball'",
          ":71:1: error: unknown key 'shinyness'", ":98:12: error: object 'wedge' overlaps object 'ring'"}) {
        INFO(part);
        const std::size_t at = result.err.find(part);
        REQUIRE(at != std::string::npos);
        CHECK(at > before);
        before = at;
    }
    CHECK(count_of(result.err, " error: ") == 7);
}

TEST_CASE("glass that absorbs light at once is an error at its place") {
    expect(checked("version = 1\n[[object]]\ntype = \"sphere\"\nreflection = \"dielectric\"\n"
                   "[object.material]\ndepth = 1e-45\n"),
           3, {"scene.toml:6:9: error: 'depth': 1e-45 is outside its range: at least 1e-06"});
}
