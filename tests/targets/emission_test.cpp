// Emission and the occlusion of ambient light in generated programs.
#include <fmt/format.h>

#include <catch2/catch_test_macros.hpp>
#include <cstdlib>
#include <string>

#include "support/command.h"
#include "support/expect.h"
#include "support/text.h"

namespace fs = std::filesystem;

namespace {

/// Values change by a few steps from texel to texel.
std::string soft_picture() {
    std::string text = "P6\n16 16\n255\n";
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x)
            for (const int value :
                 {90 + 8 * std::abs(x - 8), 200 - 9 * std::abs(y - 8), 60 + 5 * std::abs(x - y)})
                text += static_cast<char>(value);
    return text;
}

constexpr const char* k_view =
    "version = 1\n[observer]\nposition = [0, 1.5, 5]\nlook_at = [0, 0, 0]\n[image]\nwidth = 160\nheight = "
    "100\n[[light]]\ntype = \"point\"\nposition = [-2, 4, 3]\nintensity = 20\n[[light]]\ntype = "
    "\"ambient\"\nintensity = 0.5\n";

/// An object with its own textures, one with only those of emission and occlusion, one with numbers, and one
/// without any.
fs::path textured_scene(const fs::path& folder) {
    write_file(folder / "soft.ppm", soft_picture());
    return write_file(
        folder / "scene.toml",
        std::string(k_view) +
            "[[object]]\nname = \"ball\"\ntype = \"sphere\"\nradius = 0.9\nposition = [-1, 0, 0]\nshading = "
            "\"phong\"\nreflection = \"phong\"\n[object.material]\nkd = { texture = \"soft.ppm\" }\nemission "
            "= "
            "{ texture = \"soft.ppm\", scale = [0.2, 0.1, 0.3], transform = { scale = [3, 2], rotation = 20 "
            "} "
            "}\nocclusion = { texture = \"soft.ppm\", scale = 0.7, offset = 0.3 }\n"
            "[[object]]\nname = \"ring\"\ntype = \"torus\"\nposition = [1.2, 0, 0]\nrotation = [60, 20, 0]\n"
            "shading = \"gouraud\"\nreflection = \"lambert\"\n[object.material]\nka = 0.9\nemission = { "
            "texture "
            "= \"soft.ppm\", channel = \"g\" }\nemission_strength = 0.3\n"
            "[[object]]\nname = \"floor\"\ntype = \"cube\"\nsize = 3\nposition = [0, -3, 0]\nshading = "
            "\"flat\"\nreflection = \"phong\"\n[object.material]\nka = 0.5\nocclusion = 0.25\nemission = "
            "[40, "
            "90, 10]\nemission_strength = 1.5\n"
            "[[object]]\nname = \"dot\"\ntype = \"sphere\"\nradius = 0.3\nposition = [0, 1.2, 0]\nshading = "
            "\"phong\"\nreflection = \"lambert\"\n");
}

void verify(const fs::path& scene, const char* target) {
    const CommandResult result = run_candela({"verify", scene.string(), "--target", target});
    INFO(target << '\n' << result.out);
    CHECK(holds(succeeded(result).out, "match"));
}

}  // namespace

TEST_CASE("verify: a C++ program has emission and occlusion, as numbers and as textures") {
    const fs::path folder = scratch_directory();
    const fs::path scene = textured_scene(folder);
    verify(scene, "cpp");
    succeeded(
        run_candela({"generate", scene.string(), "--target", "cpp", "-o", (folder / "program").string()}));
    const std::string program = read_file(folder / "program/scene.cpp");
    CHECK(holds(program, "own.emission.x *= number_of("));
    CHECK(holds(program, "sum += o.occlusion * reflected_ambient(o, s)"));
    SECTION("also without any texture") {
        const fs::path plain =
            write_file(folder / "plain.toml", std::string(k_view) +
                                                  "[[object]]\ntype = \"sphere\"\nshading = "
                                                  "\"phong\"\nreflection = \"phong\"\n[object.material]\n"
                                                  "emission = [90, 20, 60]\nocclusion = 0.5\n");
        verify(plain, "cpp");
        succeeded(
            run_candela({"generate", plain.string(), "--target", "cpp", "-o", (folder / "plain").string()}));
        CHECK(holds(read_file(folder / "plain/scene.cpp"), "+ o.emission;"));
    }
}

TEST_CASE("verify: OpenGL programs and pages have emission and occlusion", "[whole]") {
    const fs::path scene = textured_scene(scratch_directory());
    for (const char* const target : {"opengl", "webgl"}) verify(scene, target);
}

TEST_CASE("verify: emission and occlusion of a textured material are there with another reflection model",
          "[whole]") {
    const fs::path folder = scratch_directory();
    const fs::path scene = textured_scene(folder);
    // All models are in the program; each object is drawn with another than its own.
    for (const char* const model : {"lambert", "oren-nayar"}) {
        const CommandResult result =
            run_candela({"verify", scene.string(), "--target", "cpp", "--reflection", model});
        INFO(model);
        CHECK(holds(succeeded(result).out, "match"));
    }
}

TEST_CASE("generate: the program of a scene without emission and occlusion does not mention them") {
    for (const char* const target : {"cpp", "opengl", "webgl"}) {
        const fs::path program = scratch_directory() / target;
        succeeded(run_candela({"generate", "--target", target, "-o", program.string()}));
        const std::string text =
            read_file(program / (std::string(target) == "webgl" ? "scene.html" : "scene.cpp"));
        for (const char* const word : {"own_emission", "own_occlusion", "o.emission", "o.occlusion"})
            CHECK_FALSE(holds(text, word));
    }
}
