// Every light with every reflection model, shading model and shape.
#include <fmt/format.h>

#include <catch2/catch_test_macros.hpp>
#include <cmath>

#include "support/command.h"
#include "support/plugins.h"

namespace {

struct Rendered {
    bool finite = true;
    bool negative = false;
    double brightest = 0;
    std::size_t shaded = 0;
};

Rendered render_file(const std::filesystem::path& file) {
    candela::Diagnostics diagnostics;
    candela::SceneRequest request;
    request.files = {file};
    const auto scene = candela::read_scene(request, test_registry(), diagnostics);
    INFO(diagnostics.text(false));
    REQUIRE(scene.has_value());
    const auto compiled = candela::compile(*scene, test_registry(), diagnostics);
    REQUIRE(compiled.has_value());
    candela::Film film(scene->image.width, scene->image.height, candela::PixelType::real,
                       candela::ColorEncoding::srgb);
    const auto statistics = candela::render(*compiled, film, {.threads = 2});
    Rendered result;
    result.shaded = statistics.pixels_shaded;
    for (const float x : film.view().reals) {
        result.finite = result.finite && std::isfinite(x);
        result.negative = result.negative || x < 0;
        result.brightest = std::max(result.brightest, static_cast<double>(x));
    }
    return result;
}

}  // namespace

TEST_CASE("all lights x reflection models x shading models x shapes render without a NaN") {
    const auto directory = scratch_directory();
    write_file(directory / "tetrahedron.obj",
               "v 0.5 0.5 0.5\nv -0.5 -0.5 0.5\nv -0.5 0.5 -0.5\nv 0.5 -0.5 -0.5\nf 1 2 4\nf 1 3 2\nf 1 4 "
               "3\nf 2 3 4\n");
    const std::vector<std::string> lights = {
        "type = \"ambient\"\n",
        "type = \"hemisphere\"\n",
        "type = \"distributed\"\nposition = [1, 1, 2]\nintensity = 5\n",
        "type = \"directional\"\ndirection = [-1, -1, -2]\n",
        "type = \"point\"\nposition = [1, 1, 2]\nintensity = 5\n",
        "type = \"spot\"\nposition = [1, 1, 2]\ndirection = [-1, -1, -2]\nintensity = 5\n"};
    const std::vector<std::string> shapes = {"sphere", "cube", "torus", "teapot", "mesh"};
    int rendered = 0;
    for (const std::string& shape : shapes) {
        for (const std::string& light : lights) {
            for (const char* const reflection : {"lambert", "half-lambert", "phong", "blinn-phong"}) {
                for (const char* const shading : {"flat", "gouraud", "phong", "derivative", "angle-weighted",
                                                  "area-weighted", "max-weighted"}) {
                    const std::string scene = fmt::format(
                        "version = 1\n[observer]\nposition = [1, 2, 3]\nlook_at = [0, 0, 0]\n[image]\nwidth "
                        "= 48\nheight = 48\n"
                        "[shading]\nmodel = \"{}\"\n[reflection]\nmodel = "
                        "\"{}\"\n[[light]]\n{}[[object]]\ntype = \"{}\"\n{}",
                        shading, reflection, light, shape,
                        shape == "mesh" ? "file = \"tetrahedron.obj\"\n" : "");
                    INFO(scene);
                    const Rendered picture = render_file(write_file(directory / "scene.toml", scene));
                    CHECK(picture.finite);
                    CHECK_FALSE(picture.negative);
                    CHECK(picture.shaded > 100);
                    CHECK(picture.brightest > 0.005);
                    ++rendered;
                }
            }
        }
    }
    CHECK(rendered == 6 * 4 * 7 * 5);
}
