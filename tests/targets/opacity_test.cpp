// Opacity in generated programs.
#include <fmt/format.h>

#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <cstdlib>
#include <string>

#include "support/command.h"
#include "support/expect.h"
#include "support/folder.h"
#include "support/text.h"

namespace fs = std::filesystem;

namespace {

/// Red rises and falls smoothly.
std::string soft_picture() {
    std::string text = "P6\n16 16\n255\n";
    for (int y = 0; y < 16; ++y) {
        for (int x = 0; x < 16; ++x) {
            const int value = 20 + 14 * std::abs(x - 8) + 12 * std::abs(y - 8);
            text.append(3, static_cast<char>(value));
        }
    }
    return text;
}

/// Balls, a ring and a floor that cover one another and cross, each opaque in another way.
fs::path layered_scene(const fs::path& folder, const std::string& more = {}) {
    write_file(folder / "soft.ppm", soft_picture());
    return write_file(
        folder / "scene.toml",
        "version = 1\n[observer]\nposition = [0, 1.5, 5]\nlook_at = [0, 0, 0]\n[image]\nwidth = 160\nheight "
        "= "
        "100\nsamples = 4\n[constraints]\noverlap = \"allow\"\n[[light]]\ntype = \"point\"\nposition = [-2, "
        "4, 3]\nintensity = 20\n[[light]]\ntype = \"ambient\"\nintensity = 0.5\n" +
            more +
            "[[object]]\nname = \"ball\"\ntype = \"sphere\"\nradius = 0.9\nposition = [-0.7, 0, 0]\nshading "
            "= "
            "\"phong\"\nreflection = \"phong\"\ncolor = [250, 60, 40]\n[object.material]\nopacity = 0.4\n"
            "[[object]]\nname = \"ring\"\ntype = \"torus\"\nposition = [0.3, 0, 0]\nrotation = [60, 20, 0]\n"
            "shading = \"gouraud\"\nreflection = \"lambert\"\n[object.material]\nopacity = { texture = "
            "\"soft.ppm\", transform = { scale = [3, 1] } }\nopacity_cutoff = 0.5\n"
            "[[object]]\nname = \"veil\"\ntype = \"sphere\"\nradius = 0.8\nposition = [1, 0.1, 0.3]\nshading "
            "= "
            "\"flat\"\nreflection = \"phong\"\ncolor = [40, 60, 250]\n[object.material]\nopacity = { texture "
            "= "
            "\"soft.ppm\", channel = \"g\", scale = 0.8 }\n"
            "[[object]]\nname = \"floor\"\ntype = \"cube\"\nsize = 3\nposition = [0, -2.8, 0]\nshading = "
            "\"flat\"\nreflection = \"lambert\"\n");
}

void verify(const fs::path& scene, const char* target) {
    const CommandResult result = run_candela({"verify", scene.string(), "--target", target});
    INFO(target << '\n' << result.out);
    CHECK(holds(succeeded(result).out, "match"));
}

}  // namespace

TEST_CASE("verify: a C++ program has surfaces that cover a part of what is behind them, and cut-outs") {
    const fs::path folder = scratch_directory();
    const fs::path scene = layered_scene(folder);
    verify(scene, "cpp");
    succeeded(
        run_candela({"generate", scene.string(), "--target", "cpp", "-o", (folder / "program").string()}));
    CHECK(holds(read_file(folder / "program/scene.cpp"), "opacity = number_of("));
    SECTION("also without any texture") {
        const fs::path plain = write_file(
            folder / "plain.toml",
            "version = 1\n[observer]\nposition = [0, 1.5, 5]\nlook_at = [0, 0, 0]\n[image]\nwidth = "
            "80\nheight "
            "= 50\n[[light]]\ntype = \"ambient\"\nintensity = 0.5\n[[object]]\ntype = \"sphere\"\nshading = "
            "\"phong\"\nreflection = \"phong\"\n[object.material]\nopacity = 0.5\n");
        verify(plain, "cpp");
    }
}

TEST_CASE("verify: an OpenGL program peels surfaces that cover a part of what is behind them", "[whole]") {
    verify(layered_scene(scratch_directory()), "opengl");
}

TEST_CASE("verify: a page peels surfaces that cover a part of what is behind them", "[whole]") {
    verify(layered_scene(scratch_directory()), "webgl");
}

TEST_CASE("verify: three.js peels surfaces that cover a part of what is behind them", "[whole]") {
    verify(layered_scene(scratch_directory()), "three");
}

TEST_CASE("verify: a C++ program has the shadows of surfaces that let light through", "[whole]") {
    verify(layered_scene(scratch_directory(), "[shadows]\nenabled = true\n"), "cpp");
}

TEST_CASE("verify: shaders have the shadows of surfaces that let light through", "[whole]") {
    const fs::path folder = scratch_directory();
    const fs::path scene = layered_scene(folder, "[shadows]\nenabled = true\n");
    SECTION("whose opacity has a texture, also in an OpenGL program") { verify(scene, "opengl"); }
    SECTION("whose opacity has a texture, also in a page") { verify(scene, "webgl"); }
    SECTION("whose opacity has a texture, also with three.js") { verify(scene, "three"); }
    SECTION("and read no texture if none has one") {
        std::string text = read_file(scene);
        const auto replace = [&](const std::string& texture, const std::string& number) {
            const std::size_t at = text.find(texture);
            REQUIRE(at != std::string::npos);
            text.replace(at, texture.size(), number);
        };
        replace("{ texture = \"soft.ppm\", transform = { scale = [3, 1] } }\nopacity_cutoff = 0.5", "0.6");
        replace("{ texture = \"soft.ppm\", channel = \"g\", scale = 0.8 }", "0.3");
        const fs::path constant = write_file(folder / "constant.toml", text);
        verify(constant, "opengl");
        succeeded(run_candela(
            {"generate", constant.string(), "--target", "opengl", "-o", (folder / "program").string()}));
        const std::string program = read_file(folder / "program/scene.cpp");
        CHECK(holds(program, "blocked_part"));
        CHECK_FALSE(holds(program, "textured_blocked_part"));
    }
}

TEST_CASE("generate: the program of a scene without opacity does not mention it") {
    const fs::path program = scratch_directory() / "cpp";
    succeeded(run_candela({"generate", "--target", "cpp", "-o", program.string(), "--shadows"}));
    const std::string text = read_file(program / "scene.cpp");
    for (const char* const word : {"opacity", "before[", "Crossing"}) CHECK_FALSE(holds(text, word));
}

#ifdef CANDELA_TEST_FAULTY_PLUGINS
TEST_CASE("generate: a target without opacity gets opaque objects, if that is accepted") {
    const Folder folder({{"soft.ppm", soft_picture()}});
    const auto generated = [&](const std::string& material, const char* option = "") {
        folder.write("scene.toml",
                     "version = 1\nimage = { width = 16, height = 8 }\nobserver = { position = [0, 0, 4], "
                     "look_at = [0, 0, 0] }\nshading = { model = \"phong\" }\nreflection = { model = "
                     "\"unlit\" }\n[[light]]\ntype = \"ambient\"\n"
                     "[[object]]\nname = \"ball\"\ntype = \"sphere\"\n[object.material]\n" +
                         material);
        return folder.run(
            fmt::format("generate scene.toml -o out --target approximates-what-is-exact "
                        "--plugin-dir {} {}",
                        CANDELA_TEST_FAULTY_PLUGINS, option));
    };
    const std::string left_out = "the opacity of object ball is left out";
    expect(generated("opacity = 0.5\n"), 1, {left_out});
    expect(generated("opacity = { texture = \"soft.ppm\" }\n"), 1, {left_out});
    CHECK(holds(succeeded(generated("opacity = 0.5\n", "--approximate")).err, left_out));
    CHECK_FALSE(holds(succeeded(generated("opacity = 0.5\nopacity_cutoff = 0.5\n")).err, left_out));
}
#endif
