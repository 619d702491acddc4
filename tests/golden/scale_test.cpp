// A scene is the same picture at any size: neither the near plane nor any other length is absolute.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "support/compiled.h"

namespace {

/// A ball, a ring and a teapot on a floor that extends under the observer, `unit` metres large.
std::string scene(double unit) {
    const auto at = [&](double x, double y, double z) {
        return fmt::format("[{}, {}, {}]", x * unit, y * unit, z * unit);
    };
    return fmt::format(
        "version = 1\n[room]\nwidth = {0}\nheight = {0}\ndepth = {0}\n"
        "[observer]\nposition = {1}\nlook_at = {2}\n"
        "[image]\nwidth = 160\nheight = 120\nbackground = [20, 30, 40]\n"
        "[shading]\nmodel = \"phong\"\n[reflection]\nmodel = \"phong\"\n"
        "[[light]]\ntype = \"point\"\nposition = {3}\nattenuation = \"none\"\nintensity = 1\n"
        "[[object]]\ntype = \"sphere\"\nposition = {4}\nscale = {5}\n"
        "[[object]]\ntype = \"torus\"\nposition = {6}\nscale = {5}\n"
        "[[object]]\ntype = \"teapot\"\nposition = {7}\nscale = {5}\nsegments = 6\n"
        "[[object]]\ntype = \"cube\"\nposition = {8}\nscale = {9}\n",
        16 * unit, at(0, 0.5, 4), at(0, 0, 0), at(-2, 3, 3), at(-1, 0.2, 0), unit, at(1.5, 0.3, 0),
        at(0, 0, -2), at(0, -1.125, 0), at(14, 0.25, 14));
}

std::vector<std::uint8_t> picture(double unit) {
    const Compiled made = compiled(scene(unit));
    candela::Film film(made.scene.image.width, made.scene.image.height, candela::PixelType::byte,
                       made.scene.image.color_management);
    candela::render(made.scene, film, {});
    const auto bytes = film.view().bytes;
    return {bytes.begin(), bytes.end()};
}

}  // namespace

TEST_CASE("a scene from a micrometre to a hundred kilometres is the same picture") {
    const std::vector<std::uint8_t> expected = picture(1);
    const auto lit = std::ranges::count_if(expected, [](std::uint8_t byte) { return byte > 60; });
    CHECK(lit > 20000);
    for (const int exponent : {-20, -17, -10, -4, 3, 10, 16}) {
        INFO("one unit is 2^" << exponent << " m");
        const std::vector<std::uint8_t> scaled = picture(std::ldexp(1.0, exponent));
        int differing = 0;
        for (std::size_t i = 0; i < expected.size(); ++i)
            differing += std::abs(int{expected[i]} - int{scaled[i]}) > 1 ? 1 : 0;
        CHECK(differing == 0);
    }
}
