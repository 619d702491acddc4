// Shadows on the command line: options, terms, explanations, messages.
#include <catch2/catch_approx.hpp>
#include <catch2/catch_test_macros.hpp>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "support/command.h"
#include "support/expect.h"
#include "support/folder.h"
#include "support/text.h"

namespace {

using Catch::Approx;

/// A floor whose top is at y = 0, a plate of a metre above its middle, and a lamp above the plate, so that
/// the plate's shadow is a square of two metres. The observer looks straight down from next to the plate.
const std::string k_plate = R"(version = 1
[observer]
position = [0.0, 0.8, 0.0]
look_at = [0.0, 0.0, 0.0]
up = [0.0, 0.0, -1.0]
projection = "orthographic"
height = 4.0
[image]
width = 40
height = 40
[shading]
model = "flat"
[reflection]
model = "lambert"
[[light]]
name = "lamp"
type = "point"
position = [0.0, 2.0, 0.0]
intensity = 3.0
[[object]]
name = "floor"
type = "cube"
scale = [6.0, 0.1, 6.0]
position = [0.0, -0.05, 0.0]
shading = "phong"
[[object]]
name = "plate"
type = "cube"
scale = [1.0, 0.02, 1.0]
position = [0.0, 1.0, 0.0]
)";

/// The pixels of a PPM of 40 x 40: the one in row `y` and column `x`.
int red_at(const std::string& image, std::size_t x, std::size_t y) {
    const std::size_t header = std::string_view("P6\n40 40\n255\n").size();
    return static_cast<unsigned char>(image.at(header + 3 * (40 * y + x)));
}

}  // namespace

TEST_CASE("objects block light with --shadows; none does with --no-shadows, or if the scene does not ask") {
    const Folder folder;
    folder.write("plate.toml", k_plate);
    succeeded(folder.run("render plate.toml -o without.ppm"));
    succeeded(folder.run("render plate.toml --shadows -o with.ppm"));
    succeeded(folder.run("render plate.toml --shadows --set shadows.enabled=false -o set.ppm"));
    const std::string without = folder.read("without.ppm"), with = folder.read("with.ppm");
    CHECK(folder.read("set.ppm") == without);
    CHECK(red_at(without, 20, 20) > 100);
    CHECK(red_at(with, 20, 20) == 0);  // below the plate
    CHECK(red_at(with, 28, 20) == 0);  // 0.85 m from the middle
    // The plate's lower side is at y = 0.99: its shadow ends 0.5 * 2 / 1.01 = 0.99 m from the middle.
    CHECK(red_at(with, 29, 20) == 0);
    CHECK(red_at(with, 30, 20) == red_at(without, 30, 20));
    folder.write("asks.toml", k_plate + "[shadows]\nenabled = true\n");
    succeeded(folder.run("render asks.toml -o asks.ppm"));
    CHECK(folder.read("asks.ppm") == with);
    succeeded(folder.run("render asks.toml --no-shadows -o no.ppm"));
    CHECK(folder.read("no.ppm") == without);
    expect(folder.run("render asks.toml --shadows --no-shadows -o no.ppm"), 2,
           {"--shadows and --no-shadows contradict each other"});
}

TEST_CASE("lights and objects that cast no shadows, and objects that receive none, are as without") {
    const Folder folder;
    folder.write("plate.toml", k_plate);
    succeeded(folder.run("render plate.toml -o without.ppm"));
    const std::string without = folder.read("without.ppm");
    for (const char* const setting : {"light.lamp.casts_shadows=false", "object.plate.casts_shadows=false",
                                      "object.floor.receives_shadows=false"}) {
        CAPTURE(setting);
        succeeded(folder.run("render plate.toml --shadows -o with.ppm --set " + std::string(setting)));
        CHECK(folder.read("with.ppm") == without);
        succeeded(folder.run("render plate.toml -o off.ppm --set " + std::string(setting)));
        CHECK(folder.read("off.ppm") == without);
    }
}

TEST_CASE("check --print keeps the keys of shadows, and omits what has its default") {
    const Folder folder;
    folder.write("plate.toml", k_plate);
    const std::string plain = expect(folder.run("check plate.toml --print"), 0).out;
    CHECK(!holds(plain, "shadows"));
    CHECK(!holds(plain, "occlusion"));
    const std::string printed =
        expect(folder.run("check plate.toml --print --shadows --set shadows.pattern=fixed "
                          "--set light.lamp.casts_shadows=false --set object.plate.receives_shadows=false "
                          "--set object.plate.transmits_light=false"),
               0)
            .out;
    for (const char* const line : {"[shadows]\nenabled = true\npattern = \"fixed\"\n", "casts_shadows",
                                   "receives_shadows", "transmits_light"}) {
        CAPTURE(line);
        CHECK(holds(printed, line));
    }
    folder.write("printed.toml", printed);
    CHECK(expect(folder.run("check printed.toml --print"), 0).out == printed);
}

TEST_CASE("explain says what blocks a light, where, and how far away; a free light says so") {
    const Folder folder;
    folder.write("plate.toml", k_plate);
    const std::string blocked = expect(folder.run("explain plate.toml --shadows --pixel 20,20"), 0).out;
    CHECK(holds(blocked, "visibility = [0, 0, 0]  blocked by object 'plate', triangle "));
    const auto result =
        nlohmann::json::parse(expect(folder.run("explain plate.toml --shadows --pixel 20,20 --json"), 0).out);
    const auto& light = result["fragments"][0]["points"][0]["lights"][0];
    CHECK(light["blocked_by"]["object"] == "'plate'");
    // From y = 0 to the plate's lower side, along a ray that is nearly vertical.
    CHECK(light["blocked_by"]["distance"].get<double>() == Approx(0.99).epsilon(0.005));
    CHECK(light["visibility"] == nlohmann::json::array({0, 0, 0}));
    const std::string lit = expect(folder.run("explain plate.toml --shadows --pixel 35,20"), 0).out;
    CHECK(holds(lit, "visibility = [1, 1, 1]  nothing is in the way"));
    CHECK(!holds(expect(folder.run("explain plate.toml --pixel 20,20"), 0).out, "visibility"));
}

TEST_CASE("the terms visibility and ambient_occlusion need shadows") {
    const Folder folder;
    folder.write("plate.toml", k_plate);
    succeeded(folder.run("render plate.toml --shadows --terms visibility,visibility.lamp -o a.ppm"));
    const std::string all = folder.read("a.visibility.ppm");
    CHECK(all == folder.read("a.visibility.lamp.ppm"));
    CHECK(red_at(all, 20, 20) == 0);
    CHECK(red_at(all, 35, 20) == 255);
    for (const char* const term : {"visibility", "visibility.lamp", "ambient_occlusion"}) {
        CAPTURE(term);
        expect(folder.run("render plate.toml -o a.ppm --terms " + std::string(term)), 2,
               {"needs shadows, and the scene has none; add --shadows"});
    }
    CHECK(!holds(expect(folder.run("render plate.toml -o a.ppm --terms bad"), 2).err, "visibility"));
}

TEST_CASE("keys of shadows in another program's words, and in vain, get a hint") {
    const Folder folder;
    const auto says = [&](const std::string& more, const std::string& message) {
        CAPTURE(more);
        folder.write("bad.toml", k_plate + more);
        CHECK(holds(folder.run("check bad.toml").err, message));
    };
    says("[shadow]\n", "[shadows] has 'enabled'");
    says("[shadows]\nenable = true\n", "did you mean 'enabled'?");
    says("castShadow = true\n", "did you mean 'casts_shadows'?");
    says("receiveShadow = true\n", "did you mean 'receives_shadows'?");
    says("[shadows]\npattern = \"random\"\n", "is not one of 'varied', 'fixed'");
    says("[[light]]\ntype = \"point\"\nposition = [0.0, 2.0, 1.0]\nambient_occlusion_rays = 8\n",
         "'ambient_occlusion_rays' has no effect: light/point has no ambient part");
    says("[[light]]\ntype = \"ambient\"\nambient_occlusion_rays = 5000\n", "1024");
}

TEST_CASE("a black picture whose light is all blocked says so") {
    const Folder folder;
    folder.write("plate.toml", k_plate);
    expect(folder.run("render plate.toml --shadows --set object.plate.scale=[5.0,0.02,5.0] -o a.ppm"), 0,
           {"the objects block all light that would reach a face, or reflect none of it; --no-shadows shows "
            "which"});
}
