// Physical light on the command line: exposure, tone curves, clipping.
#include <fmt/format.h>

#include <array>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <cstdlib>
#include <string>

#include "support/command.h"
#include "support/expect.h"
#include "support/folder.h"
#include "support/ppm.h"
#include "support/text.h"

namespace {

/// A white Lambert surface that fills the lower half of the picture and sends the luminance `luminance`.
std::string scene(double luminance, const std::string& observer = "", const std::string& image = "") {
    return fmt::format(
        "version = 1\n[observer]\nposition = [0, 0, 4]\nlook_at = [0, 0, 0]\nprojection = \"orthographic\"\n"
        "height = 2\n{}\n[image]\nwidth = 8\nheight = 8\nbackground = [10, 120, 250]\n{}\n[shading]\n"
        "model = \"flat\"\n[reflection]\nmodel = \"lambert\"\n[[light]]\nname = \"sun\"\n"
        "type = \"directional\"\ndirection = [0, 0, -1]\nintensity = {}\n[[object]]\ntype = \"cube\"\n"
        "size = 2\nposition = [0, -1, 0]\ncolor = [255, 255, 255]\n[object.material]\nka = 0\nkd = 1\n",
        observer, image, luminance);
}

/// The level of a linear intensity: IEC 61966-2-1.
double level_of(double x) {
    return 255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055);
}

Ppm drawn(const Folder& folder, const std::string& text, const std::string& options = "") {
    folder.write("scene.toml", text);
    succeeded(folder.run("render scene.toml -q -o a.ppm " + options));
    return read_ppm(folder / "a.ppm");
}

bool is_level(int byte, double level) { return std::abs(byte - level) < 0.52; }

}  // namespace

TEST_CASE("at EV 12, a surface's luminance is divided by 1.2 times two to the twelfth") {
    const Folder folder;
    const double level = level_of(2000 / (1.2 * 4096));
    for (const char* const exposure :
         {"exposure = \"EV 12\"", "exposure = 12", "exposure = \"EV100 12.0\"", "exposure = \"12\"",
          "exposure = { aperture = 8.0, time = 0.015625, iso = 100 }",
          "exposure = { aperture = 8.0, time = 0.0078125, iso = 200 }",
          "exposure = { aperture = 4, time = 0.00390625 }"}) {
        INFO(exposure);
        CHECK(is_level(drawn(folder, scene(2000, exposure)).at(4, 6)[0], level));
    }
    CHECK(is_level(drawn(folder, scene(2000), "--exposure 12").at(4, 6)[0], level));
    CHECK(is_level(drawn(folder, scene(2000, "exposure = 3"), "--exposure=12").at(4, 6)[0], level));
    const std::string reset = "--exposure=-0.2630344";
    CHECK(is_level(drawn(folder, scene(0.25, "exposure = 3"), reset).at(4, 6)[0], level_of(0.25)));
}

TEST_CASE("the background has its own colour at any exposure") {
    const Folder folder;
    for (const char* const exposure : {"exposure = 15", "exposure = -6"})
        CHECK(drawn(folder, scene(1, exposure)).at(4, 1) == std::array<int, 3>{10, 120, 250});
}

TEST_CASE("a tone curve follows exposure") {
    const Folder folder;
    // 3 of Reinhard's curve is 3/4; Khronos PBR Neutral subtracts 0.04 of a grey.
    const std::string exposure = fmt::format("exposure = {}", std::log2(1 / 1.2));
    CHECK(is_level(drawn(folder, scene(3, exposure, "tone = \"reinhard\"")).at(4, 6)[0], level_of(0.75)));
    CHECK(is_level(drawn(folder, scene(0.5), "--tone khronos-neutral").at(4, 6)[0], level_of(0.46)));
    const Ppm exposed = drawn(folder, scene(1200, "exposure = 10"), "--tone=reinhard");
    CHECK(is_level(exposed.at(4, 6)[0], level_of(1200 / (1.2 * 1024) / (1 + 1200 / (1.2 * 1024)))));
}

TEST_CASE("an invalid exposure or tone is explained at its place") {
    const Folder folder;
    const auto refused = [&](const std::string& text, const std::string& expected) {
        folder.write("scene.toml", text);
        expect(folder.run("check scene.toml"), 3, {expected});
    };
    refused(scene(1, "exposure = \"bright\""),
            "scene.toml:7:12: error: 'exposure' is a string, \"bright\"; expected a number, -24 to 24, or "
            "\"EV 12\"");
    refused(scene(1, "exposure = \"EV 99\""), "'exposure': 99 is outside its range: -24 to 24");
    refused(scene(1, "exposure = { aperture = 8 }"), "'exposure' has no 'time': the shutter time in seconds");
    refused(scene(1, "exposure = { aperture = 0, time = 1 }"),
            "'aperture' is the integer 0; expected the f-number");
    refused(scene(1, "exposure = { apperture = 8, time = 1 }"), "unknown key 'apperture' in 'exposure'");
    refused(scene(1, "", "tone = \"filmic\""), "'tone': \"filmic\" is not one of 'none', 'khronos-neutral'");
    refused(scene(1, "", "tonemapping = \"aces\""), "did you mean 'tone'?");
    expect(folder.run("render --defaults --tone neutral -o b.png"), 3, {"--tone"});
}

TEST_CASE("a written scene has its exposure and tone") {
    const Folder folder;
    folder.write("scene.toml", scene(1, "exposure = { aperture = 8, time = 0.015625 }", "tone = \"agx\""));
    expect_out(folder.run("check scene.toml --print"), 0, {"exposure   = 12.0\n", "\"agx\"\n"});
    folder.write("scene.toml", scene(1));
    CHECK_FALSE(holds(folder.run("check scene.toml --print").out, "exposure"));
}

TEST_CASE("pictures of floats have luminances, whatever the exposure and tone") {
    const Folder folder;
    folder.write("scene.toml", scene(2000, "exposure = 12", "tone = \"agx\""));
    succeeded(folder.run("render scene.toml -o a.pfm"));
    succeeded(folder.run("render scene.toml --exposure=-0.2630344 --tone none -o b.pfm"));
    // The background differs: it is as bright as it has to be at the exposure.
    const std::string a = folder.read("a.pfm"), b = folder.read("b.pfm");
    const std::size_t half = (a.size() - std::string("PF\n8 8\n-1.0\n").size()) / 2;
    CHECK(a.substr(0, a.size() - half) == b.substr(0, b.size() - half));
}

TEST_CASE("an explanation has the exposed and toned intensity") {
    const Folder folder;
    folder.write("scene.toml", scene(1200, "exposure = 10", "tone = \"reinhard\""));
    expect_out(folder.run("explain scene.toml --pixel 4,6"), 0,
               {"red: I = 1200, exposed x 0.000813802 = 0.976562, tone reinhard 0.494071, sRGB "});
}

TEST_CASE("a picture with many clipped pixels comes with their share, and one without has no warning") {
    const Folder folder;
    const auto said = [&](const std::string& text, const std::string& options) {
        folder.write("scene.toml", text);
        return succeeded(folder.run("render scene.toml -o " + options)).err;
    };
    const std::string much = said(scene(20), "a.png");
    CHECK(holds(much, "warning: 50 % of the pixels are clipped: light of intensity 20 is shown as 1;"));
    CHECK(holds(said(scene(9000, "exposure = 12"), "a.png"), "light of intensity 9e+03 is shown as 4.9e+03"));
    CHECK_FALSE(holds(said(scene(0.9), "a.png"), "clipped"));
    CHECK_FALSE(holds(said(scene(20), "a.png --tone agx"), "clipped"));
    CHECK_FALSE(holds(said(scene(20), "a.pfm"), "clipped"));
    CHECK_FALSE(holds(said(scene(20), "a.png --exposure 8"), "clipped"));
}

TEST_CASE("the white of a background is not clipped") {
    const Folder folder;
    std::string white = scene(20);
    white.replace(white.find("[10, 120, 250]"), 14, "[255, 255, 255]");
    const std::string own = "color = [255, 255, 255]";
    white.replace(white.find(own), own.size(), "color = [255, 0, 0]");
    folder.write("scene.toml", white);
    const char* const k_half = "warning: 50 % of the pixels are clipped";
    CHECK(holds(succeeded(folder.run("render scene.toml -o white.png")).err, k_half));
    succeeded(folder.run("render scene.toml --set observer.look_at=[0,0,8] -o sky.png"));
    CHECK(holds(succeeded(folder.run("render scene.toml --set image.environment=sky.png -o a.png")).err,
                k_half));
}

TEST_CASE("POV-Ray is exposed but refuses a tone curve, and glTF says what is left out") {
    const Folder folder;
    folder.write("scene.toml", scene(2000, "exposure = 12"));
    expect(folder.run("generate scene.toml --target povray --approximate -o out"), 0);
    expect(folder.run("generate scene.toml --target gltf -o out"), 1, {"the exposure is left out"});
    folder.write("scene.toml", scene(0.5, "", "tone = \"aces\""));
    expect(folder.run("generate scene.toml --target povray --approximate -o toned"), 1,
           {"[image] tone: ", "--tone none"});
}
