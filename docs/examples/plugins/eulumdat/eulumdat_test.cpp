#include <candela/plugin_test.h>

#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::WithinRel;

namespace {

/// A file that is removed when the test ends.
class Lamp {
  public:
    explicit Lamp(const std::string& text) {
        std::string name = (std::filesystem::temp_directory_path() / "ldt-XXXXXX").string();
        folder_ = ::mkdtemp(name.data());
        std::ofstream(path()) << text;
    }
    Lamp(const Lamp&) = delete;
    Lamp& operator=(const Lamp&) = delete;
    ~Lamp() { std::filesystem::remove_all(folder_); }
    std::string path() const { return (folder_ / "lamp.ldt").string(); }

    /// The intensity at a point of the floor from a lamp 2 m above it that points down; 1000 cd count as 1.
    float sent_to(float x, float z) const {
        const auto light = candela::sdk::make<candela::Light>(
            CANDELA_PLUGIN_DIR, "eulumdat",
            {{"file", path()}, {"position", candela::Vec3{0, 2, 0}}, {"direction", candela::Vec3{0, -1, 0}}});
        const float zero = 0, one = 1;
        float out[9] = {};
        light->illuminate(0, {.count = 1, .position = {&x, &zero, &z}, .normal = {&zero, &one, &zero}},
                          {.to_light = {out, out + 1, out + 2},
                           .diffuse = {out + 3, out + 4, out + 5},
                           .specular = {out + 6, out + 7, out + 8}});
        return out[3];
    }

  private:
    std::filesystem::path folder_;
};

/// Three angles of 45 degrees and four planes of 90; a factor of 2 and 500 lm make the values candela.
std::string lamp_of(int symmetry, const std::string& values) {
    std::string text = "maker\n3\n" + std::to_string(symmetry) + "\n4\n90\n3\n45\n";
    for (int i = 0; i < 14; ++i) text += "0\n";
    text += "100\n90\n2\n0\n1\n1\nLED\n500\n3000\n80\n5\n";
    for (int i = 0; i < 10; ++i) text += "0.5\n";
    return text + "0\n90\n180\n270\n0\n45\n90\n" + values;
}
const std::string k_lamp = lamp_of(0, "1000\n500\n0\n1000\n300\n0\n1000\n100\n0\n1000\n300\n0\n");

}  // namespace

TEST_CASE("straight below at 2 m, 1000 cd give a quarter") {
    CHECK_THAT(Lamp(k_lamp).sent_to(0, 0), WithinRel(0.25f, 1e-5f));
}

TEST_CASE("at 45 degrees, each side has its own value, divided by the square of the distance") {
    const Lamp lamp(k_lamp);
    CHECK_THAT(lamp.sent_to(0, 2), WithinRel(0.5f / 8, 1e-4f));
    CHECK_THAT(lamp.sent_to(0, -2), WithinRel(0.1f / 8, 1e-4f));
    CHECK_THAT(lamp.sent_to(2, 0), WithinRel(0.3f / 8, 1e-4f));
    CHECK_THAT(lamp.sent_to(-2, 0), WithinRel(0.3f / 8, 1e-4f));
}

TEST_CASE("planes that symmetry leaves out are mirror images") {
    // C 0, 90 and 180; one plane; C 0 and 90.
    const Lamp half(lamp_of(2, "1000\n500\n0\n1000\n300\n0\n1000\n100\n0\n"));
    CHECK_THAT(half.sent_to(2, 0), WithinRel(0.3f / 8, 1e-4f));
    CHECK_THAT(half.sent_to(-2, 0), WithinRel(0.3f / 8, 1e-4f));
    const Lamp round(lamp_of(1, "1000\n500\n0\n"));
    CHECK_THAT(round.sent_to(0, -2), WithinRel(0.5f / 8, 1e-4f));
    const Lamp quarter(lamp_of(4, "1000\n500\n0\n1000\n300\n0\n"));
    CHECK_THAT(quarter.sent_to(0, -2), WithinRel(0.5f / 8, 1e-4f));
    CHECK_THAT(quarter.sent_to(-2, 0), WithinRel(0.3f / 8, 1e-4f));
}

TEST_CASE("a file that is cut off, or not an EULUMDAT file, is refused at its line") {
    CHECK_THROWS_WITH(Lamp(k_lamp.substr(0, k_lamp.size() - 4)).sent_to(0, 0),
                      ContainsSubstring("line 61 is not a number"));
    CHECK_THROWS_WITH(Lamp("hello\n").sent_to(0, 0), ContainsSubstring("line 3 is not a number"));
}
