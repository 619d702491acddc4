#include <catch2/catch_test_macros.hpp>
#include <cstddef>

import candela.core;

TEST_CASE("a film is black until something is stored") {
    const candela::Film film(700, 500, candela::PixelType::byte, candela::ColorEncoding::srgb);
    std::size_t sum = 0;
    for (const unsigned byte : film.view().bytes) sum += byte;
    CHECK(film.view().bytes.size() == std::size_t{3} * 700 * 500);
    CHECK(sum == 0);
}
