// "Why is it black?": a picture without light comes with the reason.
#include <catch2/catch_test_macros.hpp>
#include <string>

#include "support/command.h"
#include "support/folder.h"
#include "support/text.h"

namespace {

std::string warning(const std::string& lights_and_objects, const std::string& look_at = "[0, 0, 0]",
                    const std::string& image = "a.png", int exit_code = 0) {
    const Folder directory;
    const std::string text = "version = 1\n[observer]\nposition = [0, 0, 4]\nlook_at = " + look_at +
                             "\n[image]\nwidth = 32\nheight = 32\n[shading]\nmodel = "
                             "\"phong\"\n[reflection]\nmodel = \"phong\"\n" +
                             lights_and_objects;
    const CommandResult result = run_candela(
        {"render", directory.write("scene.toml", text).string(), "-o", (directory / image).string()});
    CHECK(result.exit_code == exit_code);
    return result.err;
}

std::string light(const std::string& values) { return "[[light]]\ntype = \"point\"\n" + values; }
const std::string k_ball = "[[object]]\nname = \"ball\"\ntype = \"sphere\"\n";
const std::string k_in_front = "position = [1, 1, 3]\n";

}  // namespace

TEST_CASE("a picture that shows light gets no warning about darkness") {
    CHECK_FALSE(holds(warning(light(k_in_front) + k_ball), "lit"));
}

TEST_CASE("the absence of lights or objects is given as the reason") {
    const std::string no_lights = warning(k_ball);
    CHECK(holds(no_lights, "the scene has no lights: every object is black"));
    CHECK_FALSE(holds(no_lights, "nothing in the picture is lit"));
    CHECK(holds(warning(light(k_in_front)), "the scene has no objects"));
    CHECK_FALSE(
        holds(warning(k_ball + "[object.material]\nemission = [9, 9, 9]\n"), "the scene has no lights"));
}

TEST_CASE("if the observer looks away from all objects, the warning says where they are") {
    const std::string scene = light(k_in_front) + k_ball + "position = [0, 1, 0]\n";
    CHECK(holds(warning(scene, "[0, 0, 5]"), "looks away from all objects; object 'ball' is around [0, 1, "));
    CHECK(holds(warning(scene, "[4, 0, 1]"), "no object is within the view"));
    CHECK(holds(warning(light(k_in_front) + k_ball + "radius = 0.0001\nposition = [0, 0.02, 0]\n"),
                "none is as large as a pixel"));
}

TEST_CASE("a light behind everything visible is the reason, also with several lights") {
    CHECK(holds(warning(light("position = [0, 0, -3]\n") +
                        "[[light]]\ntype = \"directional\"\ndirection = [0, 0, 1]\n" + k_ball),
                "every light is behind every face that the observer sees"));
}

TEST_CASE("a light that emits nothing is the reason: no intensity, black, or a cone that points elsewhere") {
    CHECK(holds(warning(light(k_in_front + "intensity = 0\n") + k_ball), "no light reaches an object"));
    CHECK(holds(warning(light(k_in_front + "color = [0, 0, 0]\n") + k_ball), "no light reaches an object"));
    CHECK(holds(warning("[[light]]\ntype = \"spot\"\nposition = [0, 4, 0]\ndirection = [0, 1, 0]\n" + k_ball),
                "no light reaches an object"));
}

TEST_CASE("objects that reflect nothing are the reason") {
    CHECK(holds(warning(light(k_in_front) + k_ball + "[object.material]\nka = 0\nkd = 0\nks = 0\n"),
                "the objects reflect none of the light"));
}

TEST_CASE("light too weak for 8 bits is the reason, and a float picture of it is not black") {
    const std::string scene = light(k_in_front + "intensity = 0.0005\n") + k_ball;
    CHECK(holds(warning(scene), "the brightest point has intensity"));
    CHECK_FALSE(holds(warning(scene, "[0, 0, 0]", "a.exr"), "lit"));
}

TEST_CASE("a black object does not cause advice to add light") {
    const std::string black = "[object.material]\nka = 0\nkd = 0\nks = 1e-15\n";
    const std::string said = warning(light(k_in_front) + k_ball + black);
    CHECK(holds(said, "the objects reflect next to nothing"));
    CHECK_FALSE(holds(said, "multiply"));
    CHECK(holds(warning(light(k_in_front + "intensity = 0.0005\n") + k_ball), "intensity by "));
    CHECK_FALSE(holds(warning(light(k_in_front + "intensity = 0.0005\n") + k_ball), "e+0"));
}
