// Highlights of generated programs that mirror light from everywhere.
#include <catch2/catch_test_macros.hpp>
#include <string>

#include "support/command.h"
#include "support/expect.h"
#include "support/text.h"

namespace fs = std::filesystem;

namespace {

/// Metals of several widths, one with a texture of its roughness, under a picture and a gradient, next to
/// models that mirror nothing.
fs::path mirroring_scene(const fs::path& folder) {
    std::string picture = "P6\n32 16\n255\n";
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 32; ++x)
            for (const int value : {x > 20 && x < 25 && y < 8 ? 255 : 70 + 3 * x, 150 - 5 * y, 8 * y + 2 * x})
                picture += static_cast<char>(value);
    write_file(folder / "room.ppm", picture);
    return write_file(
        folder / "scene.toml",
        "version = 1\n[observer]\nposition = [0, 1.5, 5]\nlook_at = [0, 0, 0]\n[image]\nwidth = 160\nheight "
        "= "
        "100\n[[light]]\nname = \"room\"\ntype = \"environment\"\npicture = \"room.ppm\"\nrotation = 40\n"
        "intensity = 0.8\nsamples = 16\n[[light]]\nname = \"glow\"\ntype = \"gradient\"\nintensity = 0.3\n"
        "samples = 8\n[[light]]\ntype = \"point\"\nposition = [-2, 4, 3]\nintensity = 8\n"
        "[[object]]\nname = \"mirror\"\ntype = \"sphere\"\nradius = 0.8\nposition = [-1.6, 0, 0]\nshading = "
        "\"phong\"\nreflection = \"metallic-roughness\"\n[object.material]\nmetallic = 1\nroughness = 0.05\n"
        "occlusion = 0.8\n"
        "[[object]]\nname = \"rough\"\ntype = \"sphere\"\nradius = 0.7\nshading = \"phong\"\nreflection = "
        "\"metallic-roughness\"\n[object.material]\nmetallic = 0.5\nroughness = { texture = \"room.ppm\", "
        "channel = \"g\", scale = 0.8 }\n"
        "[[object]]\nname = \"ring\"\ntype = \"torus\"\nposition = [1.6, 0, 0]\nrotation = [60, 20, 0]\n"
        "shading = \"gouraud\"\nreflection = \"ggx\"\n[object.material]\nroughness = 0.4\n"
        "[[object]]\nname = \"matt\"\ntype = \"cube\"\nsize = 3\nposition = [0, -2.6, 0]\nshading = "
        "\"flat\"\n"
        "reflection = \"phong\"\n");
}

void verify(const fs::path& scene, const char* target, const std::vector<std::string>& more = {}) {
    const CommandResult result = run_candela(joined({"verify", scene.string(), "--target", target}, more));
    INFO(target << '\n' << result.out << result.err);
    CHECK(holds(succeeded(result).out, "match"));
}

}  // namespace

TEST_CASE("verify: a C++ program mirrors light from everywhere") {
    const fs::path folder = scratch_directory(), scene = mirroring_scene(folder);
    verify(scene, "cpp");
    verify(scene, "cpp", {"--shadows"});
}

TEST_CASE("verify: OpenGL programs and pages mirror light from everywhere", "[whole]") {
    const fs::path scene = mirroring_scene(scratch_directory());
    for (const char* const target : {"opengl", "webgl"}) {
        verify(scene, target);
        verify(scene, target, {"--shadows"});
    }
}

TEST_CASE("generate: targets without mirror images report that they show samples instead") {
    const fs::path folder = scratch_directory(), scene = mirroring_scene(folder);
    for (const char* const target : {"povray", "gltf"}) {
        const CommandResult result =
            run_candela({"generate", scene.string(), "--target", target, "-o", (folder / target).string()});
        INFO(target << '\n' << result.err);
        CHECK(result.exit_code != 0);
        CHECK(holds(result.err, "highlights show the samples of light 'room' instead of its mirror image"));
    }
}

TEST_CASE("generate: the program of a scene without mirror images does not mention them") {
    for (const char* const target : {"cpp", "opengl", "webgl"}) {
        const fs::path program = scratch_directory() / target;
        succeeded(run_candela({"generate", "--target", target, "-o", program.string()}));
        const std::string text =
            read_file(program / (std::string(target) == "webgl" ? "scene.html" : "scene.cpp"));
        for (const char* const word : {"mirror_sample", "RadianceMap", "radiance.pfm"})
            CHECK_FALSE(holds(text, word));
        CHECK_FALSE(fs::exists(program / "radiance.pfm"));
    }
}
