// Scenes that the constraints on a whole scene accept or reject (CA Table 1).
#include <fmt/format.h>

#include <catch2/catch_test_macros.hpp>
#include <string>

#include "console/diagnostics_text.h"
#include "support/command.h"
#include "support/plugins.h"
#include "support/scene_tables.h"
#include "support/text.h"

namespace {

struct Result {
    bool is_valid = false;
    std::string text;
};

/// A box around the origin, as an OBJ file with its first `faces` faces; six close it.
std::string box_obj(int faces) {
    static constexpr const char* k_faces[] = {"f 1 4 3 2\n", "f 5 6 7 8\n", "f 1 2 6 5\n",
                                              "f 2 3 7 6\n", "f 3 4 8 7\n", "f 4 1 5 8\n"};
    std::string obj = "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n";
    for (int i = 0; i < faces; ++i) obj += k_faces[i];
    return obj;
}

constexpr const char* k_box = "[[object]]\nname = \"box\"\ntype = \"mesh\"\nfile = \"box.obj\"\n";

Result checked(const std::string& tables, int faces_of_the_box = 6) {
    const auto directory = scratch_directory();
    write_file(directory / "box.obj", box_obj(faces_of_the_box));
    candela::SceneRequest request;
    request.files = {write_file(directory / "scene.toml", k_start + k_models + tables)};
    candela::Diagnostics diagnostics;
    const auto draft = candela::draft_scene(request, test_registry(), diagnostics);
    if (draft) candela::build(*draft, test_registry(), diagnostics);
    return {!diagnostics.has_errors(), diagnostics_text(diagnostics, false)};
}

bool says(const Result& result, const char* part) { return result.text.find(part) != std::string::npos; }

constexpr const char* k_lamp = "[[light]]\nname = \"lamp\"\ntype = \"point\"\nposition = [0, 0.1, 0]\n";

}  // namespace

TEST_CASE("a light is an error inside a closed mesh, but not inside an open one") {
    const Result closed = checked(std::string(k_lamp) + k_box);
    CHECK_FALSE(closed.is_valid);
    CHECK(says(closed, "light 'lamp' is inside object 'box'"));
    CHECK(checked(std::string(k_lamp) + k_box, 5).is_valid);
}

TEST_CASE(
    "lights, the observer and other objects may be inside an object that encloses them, but may not cross "
    "it") {
    const std::string room = std::string(k_box) + "scale = 4.5\nencloses = true\n";
    const std::string ball = "[[object]]\nname = \"ball\"\ntype = \"sphere\"\nposition = ";
    const Result inside = checked(k_lamp + room + ball + "[2, 0, 0]\n");
    INFO(inside.text);
    CHECK(inside.is_valid);
    const Result crossing = checked(k_lamp + room + ball + "[4.4, 0, 0]\n");
    CHECK_FALSE(crossing.is_valid);
    CHECK(says(crossing, "object 'ball' overlaps object 'box'"));
    // An object inside is as solid as any other.
    CHECK(says(checked(k_lamp + room + ball + "[0, 0, 0]\n"), "light 'lamp' is inside object 'ball'"));
    CHECK_FALSE(checked(std::string(k_lamp) + k_box + "scale = 4.5\n").is_valid);
}

TEST_CASE("objects that overlap are a warning if the scene says so, and an error otherwise") {
    const std::string two = std::string(k_lamp) +
                            "[[object]]\ntype = \"cube\"\nposition = [1, 0, 0]\n"
                            "[[object]]\ntype = \"cube\"\nposition = [1.5, 0, 0]\n";
    CHECK_FALSE(checked(two).is_valid);
    const Result warned = checked(two + "[constraints]\noverlap = \"warn\"\n");
    CHECK(warned.is_valid);
    CHECK(says(warned, "warning: object number 1 overlaps object number 0"));
    CHECK(checked(two + "[constraints]\noverlap = \"error\"\n").text == checked(two).text);
    CHECK(says(checked(two + "[constraints]\noverlap = \"wrn\"\n"), "did you mean 'warn'?"));
    const Result allowed = checked(two + "[constraints]\noverlap = \"allow\"\n");
    CHECK_FALSE(holds(allowed.text, "overlaps"));
}

TEST_CASE("long bodies next to each other, whose bounding boxes all overlap, do not overlap") {
    // Rods along the diagonal of a cube, next to each other in a plane: their boxes separate no pair.
    std::string scene = "[room]\nwidth = 100\nheight = 100\ndepth = 100\n[[light]]\ntype = \"ambient\"\n";
    constexpr int k_rods = 1500;
    for (int i = 0; i < k_rods; ++i) {
        const double aside = 0.01 * (i - 0.5 * k_rods);
        scene += fmt::format(
            "[[object]]\ntype = \"cube\"\nposition = [{}, {}, -10]\nrotation = [0, 0, 45]\nscale = [40, "
            "0.005, 0.005]\n",
            -aside, aside);
    }
    CHECK(checked(scene).is_valid);
    scene +=
        "[[object]]\ntype = \"cube\"\nposition = [0, 0, -10]\nrotation = [0, 0, -45]\nscale = [0.02, 0.005, "
        "0.005]\n";
    CHECK_FALSE(checked(scene).is_valid);
}
