// Pictures that surround the scene, and files that cannot.
#include <catch2/catch_test_macros.hpp>
#include <string>
#include <utility>
#include <vector>

#include "support/command.h"
#include "support/expect.h"
#include "support/folder.h"
#include "support/scene_tables.h"

namespace {

CommandResult render(const std::string& image, const Folder& directory,
                     const std::vector<std::pair<std::string, std::string>>& environment = {}) {
    directory.write("scene.toml", "version = 1\n" + image_table(16, 8) + image + "\n" + k_observer +
                                      models("phong", "dielectric") +
                                      "[[light]]\ntype = \"ambient\"\n[[object]]\ntype = \"sphere\"\n");
    return directory.run("render scene.toml -o out.ppm", {}, environment);
}

/// Four pixels: red to the left of the picture's middle, blue to the right.
const std::string k_image = std::string("P6\n4 1\n255\n") + "\xff" + std::string(2, '\0') + "\xff" +
                            std::string(4, '\0') + "\xff" + std::string(2, '\0') + "\xff";

CommandResult render_lit(const std::string& lights, const Folder& directory, const std::string& image = "") {
    directory.write("scene.toml", "version = 1\n" + image_table(16, 8) + image + "\n" + k_observer +
                                      models("phong", "lambert") + lights +
                                      "[[object]]\ntype = \"sphere\"\n");
    return directory.run("render scene.toml -o out.ppm");
}

std::string pixels_of(const Folder& directory) {
    const std::string picture = directory.read("out.ppm");
    return picture.substr(picture.size() - std::size_t{16} * 8 * 3);
}

}  // namespace

TEST_CASE(
    "a light that is the background is seen as the same picture in [image] is, and lights the objects") {
    const Folder d({{"sky.ppm", k_image}});
    const std::string light = "[[light]]\ntype = \"environment\"\npicture = \"sky.ppm\"\n";
    succeeded(render_lit(light, d, "environment = \"sky.ppm\"\n"));
    const std::string apart = pixels_of(d);
    succeeded(render_lit(light + "background = true\n", d));
    CHECK(pixels_of(d) == apart);
    // The middle of the sphere, lit from both sides.
    const std::size_t middle = (4 * 16 + 8) * std::size_t{3};
    CHECK(static_cast<unsigned char>(apart[middle]) > 60);
    CHECK(static_cast<unsigned char>(apart[middle + 2]) > 60);
}

TEST_CASE("a background light in a wrong place is reported there") {
    const Folder d({{"sky.ppm", k_image}});
    const std::string light = "[[light]]\ntype = \"environment\"\nbackground = true\n";
    expect(render_lit("[[light]]\ntype = \"point\"\nposition = [0, 3, 3]\nbackground = true\n", d), 3,
           {"error: light number 0: light/point cannot be the background", "remove 'background'"});
    expect(render_lit(light + light, d), 3,
           {"error: light number 0 is the background already; expected one light with 'background'"});
    expect(render_lit(light, d, "environment = \"sky.ppm\"\n"), 0,
           {"warning: 'environment' has no effect: light number 0 is the background"});
    expect(render_lit("[[light]]\ntype = \"environment\"\nvisible = true\n", d), 3, {"background"});
    expect(d.run("generate scene.toml --target cpp -o program"), 3, {"background"});
}

TEST_CASE("a program is refused for a light that is the background, with what to do") {
    const Folder d;
    succeeded(render_lit("[[light]]\nname = \"all\"\ntype = \"environment\"\nbackground = true\n", d));
    expect(d.run("generate scene.toml --target cpp -o program"), 1,
           {"the background of a generated program is one colour", "--set light.all.background=false"});
    expect(d.run("generate scene.toml --target cpp -o program --set light.all.background=false"), 0);
}

TEST_CASE("an environment picture, relative to the scene's file, is visible around the object") {
    const Folder d({{"sky.ppm", k_image}});
    succeeded(render("environment = \"sky.ppm\"", d));
    const std::string picture = d.read("out.ppm");
    const std::size_t first = picture.size() - std::size_t{16} * 8 * 3;
    CHECK(static_cast<unsigned char>(picture[first]) > 150);  // red at the left edge
    CHECK(static_cast<unsigned char>(picture[first + 15 * 3]) < 150);
    CHECK(static_cast<unsigned char>(picture[first + 15 * 3 + 2]) > 150);  // blue at the right
}

TEST_CASE("mistakes in the environment are reported at its place") {
    const Folder d({{"sky.ppm", k_image}});
    expect(render("environment = \"sea.ppm\"", d), 3, {"scene.toml:5:15: error: 'sea.ppm' does not exist"});
    expect(render("environment = \".\"", d), 3, {"scene.toml:5:15: error: '.' is a directory, not a file"});
    expect(render("environment = 3", d), 3,
           {"scene.toml:5:15: error: 'environment' is the integer 3; expected"});
    expect(render("background = [1, 2, 3]\nenvironment = \"sky.ppm\"", d), 0,
           {"scene.toml:5:1: warning: 'background' has no effect with an environment"});
}

TEST_CASE("an environment that cannot be read as a picture is a failure that names the file") {
    const Folder d;
    d.write("sky.txt", "blue");
    d.write("sky.png", "blue");
    d.write("short.ppm", k_image.substr(0, 14));
    d.write("sky.pfm",
            std::string("PF\n1 1\n-1.0\n") + std::string("\0\0\xc0\x7f", 4) + std::string(8, '\0'));
    expect(
        render("environment = \"sky.txt\"", d), 1,
        {"scene.toml:5:15: error: environment: ", "sky.txt' has a format that no image plugin reads", "exr"});
    expect(render("environment = \"sky.png\"", d), 1, {"sky.png' cannot be read as a picture"});
    expect(render("environment = \"short.ppm\"", d), 1, {"short.ppm' cannot be read as a picture"});
    expect(render("environment = \"sky.pfm\"", d), 1,
           {"sky.pfm' cannot be read as a picture: a pixel is non-finite"});
    CHECK_FALSE(d.has("out.ppm"));
}

TEST_CASE(
    "without Embree, a scene with a transparent object or shadows is an error that names the package; any "
    "other renders") {
    const Folder d;
    for (const char* const name : {"libembree3.so.3", "libembree4.so.4"})
        write_file(d / "hidden" / name, "no library");
    const std::vector<std::pair<std::string, std::string>> hidden{
        {"LD_LIBRARY_PATH", (d / "hidden").string()}};
    const CommandResult result = render("", d, hidden);
    expect(result, 1,
           {"Embree follows rays to lights and within transparent objects", "Debian's package libembree"});
    CHECK_FALSE(d.has("out.ppm"));
    expect(d.run("render scene.toml --reflection phong --shadows -o out.ppm", {}, hidden), 1,
           {"shadows: Embree follows rays to lights", "Debian's package libembree"});
    CHECK_FALSE(d.has("out.ppm"));
    expect(d.run("render scene.toml --reflection phong -o out.ppm", {}, hidden), 0);
}
