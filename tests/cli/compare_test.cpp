// candela compare: compares sheets with the pictures that `render` writes, and with differences computed by
// hand.
#include <catch2/catch_approx.hpp>
#include <catch2/catch_test_macros.hpp>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/command.h"
#include "support/expect.h"
#include "support/folder.h"
#include "support/ppm.h"
#include "support/text.h"

using Catch::Approx;
using Json = nlohmann::json;

namespace {

/// The front face of a cube fills the picture; light falls on it at 60 degrees.
constexpr const char* k_face = R"(version = 1
[observer]
position = [0.0, 0.0, 4.0]
look_at = [0.0, 0.0, 0.0]
projection = "orthographic"
height = 0.5
[image]
width = 60
height = 40
color_management = "none"
[shading]
model = "flat"
[reflection]
model = "lambert"
[[light]]
name = "sun"
type = "directional"
direction = [0.8660254, 0.0, -0.5]
[[object]]
type = "cube"
color = [255, 255, 255]
[object.material]
kd = 0.8
)";

class Sheets : public Folder {
  public:
    Sheets() : Folder({{"face.toml", k_face}}) {}

    Ppm made(const std::vector<std::string>& words, const std::string& file) const {
        succeeded(run_words(words));
        return read_ppm(*this / file);
    }
    std::string error(const std::vector<std::string>& words, int exit_code) const {
        const CommandResult result = expect(run("compare face.toml", words), exit_code);
        CHECK_FALSE(has("comparison.png"));
        return result.err;
    }
};

constexpr int k_margin = 4, k_line = 10;

}  // namespace

TEST_CASE("each picture on a sheet is, byte for byte, the one that `render` makes of that combination") {
    const Sheets folder;
    const std::vector<std::string> reflections{"lambert", "half-lambert", "phong"}, shadings{"flat", "phong"};
    const Ppm sheet = folder.made({"compare", "face.toml", "--reflection", "lambert,half-lambert,phong",
                                   "--shading=flat,phong", "-o", "sheet.ppm"},
                                  "sheet.ppm");
    CHECK(sheet.width == 3 * (60 + k_margin) + k_margin);
    CHECK(sheet.height == 2 * (40 + 2 * k_margin + k_line) + k_margin);
    for (std::size_t row = 0; row < shadings.size(); ++row) {
        for (std::size_t column = 0; column < reflections.size(); ++column) {
            const Ppm alone = folder.made({"render", "face.toml", "--reflection", reflections[column],
                                           "--shading", shadings[row], "-o", "alone.ppm"},
                                          "alone.ppm");
            const int x = k_margin + static_cast<int>(column) * (60 + k_margin),
                      y = k_margin + static_cast<int>(row) * (40 + 2 * k_margin + k_line);
            INFO(reflections[column] << " " << shadings[row]);
            CHECK(sheet.part(x, y, 60, 40) == alone.bytes);
            // Its label: ink on paper below it.
            const std::string label = sheet.part(x, y + 40 + k_margin, 60, k_line);
            CHECK(label.find_first_not_of(label.front()) != std::string::npos);
        }
    }
}

TEST_CASE("values are compared like models, and a single axis is broken into rows") {
    const Sheets folder;
    const Ppm sheet = folder.made({"compare", "face.toml", "--vary", "light.sun.intensity=0.2,0.4,0.6,0.8",
                                   "--vary", "object.0.color=[255,0,0]", "--columns=2", "-o", "sheet.ppm"},
                                  "sheet.ppm");
    CHECK(sheet.width == 2 * (60 + k_margin) + k_margin);
    // 255 k_d I N.L = 255 * 0.8 * 0.6 * 0.5, in the second row's first picture.
    const std::string pixel = sheet.part(k_margin + 30, k_margin + 40 + 2 * k_margin + k_line + 20, 1, 1);
    CHECK(static_cast<unsigned char>(pixel[0]) == 61);
    CHECK(pixel[1] == 0);
}

TEST_CASE("with --difference, a sheet shows how much each picture differs from the first") {
    const Sheets folder;
    const CommandResult result =
        folder.run_words({"compare", "face.toml", "--reflection=lambert,half-lambert,lambert ",
                          "--difference", "--json", "-o", "sheet.ppm"});
    CHECK(result.exit_code != 0);  // "lambert " is not a model
    const CommandResult sound = succeeded(
        folder.run_words({"compare", "face.toml", "--reflection=lambert,half-lambert", "--vary",
                          "light.sun.intensity=1,0.5", "--difference", "--json", "-o", "sheet.ppm"}));
    const Json images = Json::parse(sound.out)["pictures"];
    REQUIRE(images.size() == 4);
    CHECK_FALSE(images[0].contains("difference"));
    CHECK(images[3]["settings"] == Json{{"reflection", "half-lambert"}, {"light.sun.intensity", "0.5"}});
    CHECK(images[3]["column"] == 1);
    CHECK(images[3]["row"] == 1);
    // Lambert: 255 k_d cos 60 = 102. Half Lambert: 255 k_d (0.5 cos 60 + 0.5)^2 = 114.75, a byte of 115. Half
    // the light: 51 and 57.
    CHECK(images[1]["difference"]["mean"].get<double>() == Approx(13));
    CHECK(images[2]["difference"]["maximum"].get<double>() == Approx(51));
    CHECK(images[3]["difference"]["rmse"].get<double>() == Approx(45).margin(1.01));
    const Ppm sheet = read_ppm(folder / "sheet.ppm");
    // The largest difference is white.
    CHECK(static_cast<unsigned char>(
              sheet.part(k_margin + 30, k_margin + 40 + 2 * k_margin + k_line + 20, 1, 1)[0]) == 255);
}

TEST_CASE("diagnostics of a later picture are reported, and those of all pictures only once") {
    const Sheets folder;
    const CommandResult result =
        expect(folder.run_words({"compare", "face.toml", "--reflection=phong", "--vary",
                                 "object.0.material.ks=0.1,0.9,0.1e0", "-o", "sheet.ppm"}),
               0);
    const std::size_t first = result.err.find("warning");
    REQUIRE(first != std::string::npos);
    CHECK(result.err.find("warning", first + 1) == std::string::npos);
}

TEST_CASE("an impossible comparison is an error with a reason, and no sheet") {
    const Sheets folder;
    CHECK(holds(folder.error({}, 2), "nothing to compare"));
    CHECK(holds(folder.error({"--reflection=phong"}, 2), "nothing to compare"));
    CHECK(holds(folder.error({"--reflection=phong,"}, 2), "a value is missing in 'phong,'"));
    CHECK(holds(folder.error({"--reflection=phong,phong"}, 2), "'phong' is repeated"));
    CHECK(holds(folder.error(
                    {"--reflection=phong,lambert", "--shading=flat,phong", "--vary", "image.samples=1,4"}, 2),
                "a sheet has two axes"));
    const std::string unknown = folder.error({"--reflection=lambert,phnog"}, 3);
    CHECK(holds(unknown, "phnog"));
    CHECK(holds(unknown, "did you mean 'phong'"));
    CHECK(holds(unknown, "in the picture 'phnog'"));
    CHECK(holds(folder.error({"--reflection=lambert,phong", "-o", "face.toml"}, 2),
                "has a format that no image plugin writes"));
    CHECK(holds(folder.error({"--reflection=lambert,phong", "--columns=3"}, 2), "expected 1 to 2"));
    CHECK(holds(folder.error({"--vary", "image.width=60,70"}, 2), "differ in size"));
    CHECK(holds(folder.error({"--vary", "image.width"}, 2), "has no '='"));
    CHECK(holds(folder.error({"--vary", "image.samples=1,4", "--vary", "image.samples=8,16"}, 2),
                "is repeated"));
    CHECK(holds(folder.error({"--reflection=phong,ggx", "--vary", "reflection.model=lambert,ggx"}, 2),
                "set the same value"));
    CHECK(holds(folder.error({"-q", "--reflection=lambert,phnog"}, 3), "in the picture 'phnog'"));
}
