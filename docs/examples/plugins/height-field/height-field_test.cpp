#include <candela/plugin_test.h>

#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::WithinRel;

namespace {

/// A file that is removed when the test ends.
class Grid {
  public:
    explicit Grid(const std::string& text) {
        std::string name = (std::filesystem::temp_directory_path() / "height-field-XXXXXX").string();
        folder_ = ::mkdtemp(name.data());
        std::ofstream(path()) << text;
    }
    Grid(const Grid&) = delete;
    Grid& operator=(const Grid&) = delete;
    ~Grid() { std::filesystem::remove_all(folder_); }
    std::string path() const { return (folder_ / "terrain.asc").string(); }

  private:
    std::filesystem::path folder_;
};

}  // namespace

TEST_CASE("a slope of 3 in 4 has 5/4 of its flat area, and its highest cells are in the north") {
    const Grid grid(
        "ncols 3\nNROWS 2\nxllcorner 0\nyllcorner 0\ncellsize 4\nNODATA_value -9999\n3 3 3\n0 0 -9999\n");
    const auto shape = candela::sdk::make<candela::Shape>(CANDELA_PLUGIN_DIR, "height-field",
                                                          {{"file", grid.path()}, {"width", 8.0}});
    const candela::sdk::Triangles triangles(*shape);
    REQUIRE(triangles.size() == 4);
    float area = 0;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const candela::Vec3 a = triangles.corner(t, 0);
        const candela::Vec3 normal = cross(triangles.corner(t, 1) - a, triangles.corner(t, 2) - a);
        CHECK(normal.y > 0);
        CHECK(normal.z > 0);
        area += length(normal) / 2;
    }
    CHECK_THAT(area, WithinRel(8.0f * 5, 1e-5f));
}

TEST_CASE("a grid that ends too early is refused with a message that says so") {
    const Grid grid("ncols 3\nnrows 2\ncellsize 1\n1 2 3 4\n");
    CHECK_THROWS_WITH(
        candela::sdk::make<candela::Shape>(CANDELA_PLUGIN_DIR, "height-field", {{"file", grid.path()}}),
        ContainsSubstring("it ends after 4 of 6 heights"));
}
