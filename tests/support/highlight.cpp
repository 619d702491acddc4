#include "support/highlight.h"

#include <cstddef>

#include "support/compiled.h"
#include "support/scene_tables.h"

double highlight_aspect(const std::string& reflection, const std::string& material) {
    constexpr int k_size = 96;
    const Compiled ball = compiled(k_start + "projection = \"orthographic\"\nheight = 2.2\n" +
                                   image_table(k_size, k_size) + models("phong", reflection) +
                                   "[[light]]\ntype = \"directional\"\ndirection = [0, 0, -1]\n"
                                   "[[object]]\ntype = \"sphere\"\nradius = 1\ncolor = [255, 255, 255]\n"
                                   "material = { " +
                                   material + " }\n");
    candela::Film film(k_size, k_size, candela::PixelType::real, candela::ColorEncoding::none);
    candela::render(ball.scene, film, {.threads = 1});
    const double middle = 0.5 * (k_size - 1);
    double x2 = 0, y2 = 0;
    for (int row = 0; row < k_size; ++row) {
        for (int column = 0; column < k_size; ++column) {
            const auto i = 3 * (static_cast<std::size_t>(row) * k_size + static_cast<std::size_t>(column));
            const double b = static_cast<double>(film.view().reals[i]);
            x2 += b * (column - middle) * (column - middle);
            y2 += b * (row - middle) * (row - middle);
        }
    }
    return x2 / y2;
}
