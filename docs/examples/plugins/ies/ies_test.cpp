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
        std::string name = (std::filesystem::temp_directory_path() / "ies-XXXXXX").string();
        folder_ = ::mkdtemp(name.data());
        std::ofstream(path()) << text;
    }
    Lamp(const Lamp&) = delete;
    Lamp& operator=(const Lamp&) = delete;
    ~Lamp() { std::filesystem::remove_all(folder_); }
    std::string path() const { return (folder_ / "lamp.ies").string(); }

    /// The intensity at a point of the floor from a lamp 2 m above it that points down; 1000 cd count as 1.
    float sent_to(float x, float z) const {
        const auto light = candela::sdk::make<candela::Light>(
            CANDELA_PLUGIN_DIR, "ies",
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

// Two vertical angles, four horizontal ones; multiplier 2 and ballast factor 0.5.
const std::string k_lamp =
    "IESNA:LM-63-2002\n[TEST] none\nTILT=NONE\n1 1000 2 3 4 1 2 0 0 0\n0.5 1 40\n"
    "0 45 90\n0 90 180 270\n1000 500 0\n1000,300,0\n1000 100 0\n1000 300 0\n";

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

TEST_CASE("a file that is cut off, or not an IES file, is refused") {
    CHECK_THROWS_WITH(Lamp(k_lamp.substr(0, k_lamp.size() - 20)).sent_to(0, 0),
                      ContainsSubstring("ends before its last candela"));
    CHECK_THROWS_WITH(Lamp("hello\n").sent_to(0, 0), ContainsSubstring("TILT=NONE"));
}
