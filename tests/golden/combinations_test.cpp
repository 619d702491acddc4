// Every light with every reflection model, shading model and shape.
#include <fmt/format.h>

#include <catch2/catch_test_macros.hpp>
#include <cmath>

#include "support/command.h"
#include "support/compiled.h"
#include "support/plugins.h"

namespace {

struct Rendered {
    bool finite = true;
    bool negative = false;
    double brightest_on_object = 0;
    std::size_t shaded = 0;
};

Rendered render_file(const std::filesystem::path& file) {
    candela::SceneRequest request;
    request.files = {file};
    const candela::RenderScene scene = compiled(request).scene;
    candela::Film film(scene.image.width, scene.image.height, candela::PixelType::real,
                       candela::ColorEncoding::srgb);
    const auto statistics = candela::render(scene, film, {.threads = 2});
    Rendered result;
    result.shaded = statistics.pixels_shaded;
    for (const float x : film.view().reals) {
        result.finite = result.finite && std::isfinite(x);
        result.negative = result.negative || x < 0;
    }
    result.brightest_on_object = static_cast<double>(statistics.brightest);
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
        "type = \"environment\"\n",
        "type = \"gradient\"\n",
        "type = \"sky\"\n",
        "type = \"studio\"\n",
        "type = \"ies\"\nposition = [1, 1, 2]\ndirection = [-1, -1, -2]\nintensity = 5\n",
        "type = \"distributed\"\nposition = [1, 1, 2]\nintensity = 5\n",
        "type = \"directional\"\ndirection = [-1, -1, -2]\n",
        "type = \"point\"\nposition = [1, 1, 2]\nintensity = 5\n",
        "type = \"spot\"\nposition = [1, 1, 2]\ndirection = [-1, -1, -2]\nintensity = 5\n"};
    const std::vector<std::string> shapes = {"sphere", "cube", "torus", "teapot", "mesh"};
    const std::vector<std::string> reflections = test_registry().names(candela::PluginKind::reflection);
    const std::vector<std::string> shadings = test_registry().names(candela::PluginKind::shading);
    std::size_t rendered = 0;
    for (const std::string& shape : shapes) {
        for (const std::string& light : lights) {
            for (const std::string& reflection : reflections) {
                for (const std::string& shading : shadings) {
                    const std::string scene = fmt::format(
                        "version = 1\n[observer]\nposition = [1, 2, 3]\nlook_at = [0, 0, 0]\n[image]\nwidth "
                        "= 48\nheight = 48\nbackground = [90, 90, 90]\n"
                        "[shading]\nmodel = \"{}\"\n[reflection]\nmodel = "
                        "\"{}\"\n[[light]]\n{}[[object]]\ntype = \"{}\"\n{}",
                        shading, reflection, light, shape,
                        shape == "mesh" ? "file = \"tetrahedron.obj\"\n" : "");
                    INFO(scene);
                    const Rendered picture = render_file(write_file(directory / "scene.toml", scene));
                    CHECK(picture.finite);
                    CHECK_FALSE(picture.negative);
                    CHECK(picture.shaded > 100);
                    // Gooch's tones replace ambient light, and unlit reflects nothing else; a transparent
                    // object shows the background.
                    const bool is_ambient = light == lights[0] || light == lights[1];
                    const bool is_unlit = reflection == "unlit" && !is_ambient;
                    CHECK((picture.brightest_on_object > 0.005 || is_unlit ||
                           (reflection == "gooch" && is_ambient)));
                    ++rendered;
                }
            }
        }
    }
    CHECK(reflections.size() >= 13);
    CHECK(shadings.size() >= 7);
    CHECK(rendered == lights.size() * reflections.size() * shadings.size() * shapes.size());
}
