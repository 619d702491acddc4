#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "support/samples.h"

namespace {

using candela::ColorEncoding;

/// IEC 61966-2-1:1999, times 255.
double srgb_255(double x) {
    return 255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055);
}

/// Intensities from black to white and, where the curve is steepest, many near black.
std::vector<float> intensities() {
    std::vector<float> all;
    for (int i = 0; i <= 50000; ++i) {
        const float x = static_cast<float>(i) / 50000.0f;
        all.push_back(x);
        all.push_back(x * x * x);
    }
    return all;
}

/// Calls `check(intensity, byte)` for all of the red channel, stored in rows of every batch size and with
/// every instruction set.
template <class Check>
void each_stored(const std::vector<float>& red, ColorEncoding encoding, Check check) {
    const std::vector<float> zero(red.size());
    each_way([&](std::size_t columns) {
        const auto width = static_cast<int>(columns);
        const auto height = static_cast<int>(red.size() / columns);
        candela::Film film(width, height, candela::PixelType::byte, encoding);
        film.store(0, 0, width, height, {red.data(), zero.data(), zero.data()}, width);
        for (std::size_t i = 0; i < film.view().bytes.size() / 3; ++i)
            check(red[i], int{film.view().bytes[3 * i]});
    });
}

/// The largest distance of a byte from `curve(intensity)`.
template <class Curve>
double furthest_from(Curve curve, ColorEncoding encoding) {
    double furthest = 0;
    each_stored(intensities(), encoding, [&](float x, int byte) {
        furthest = std::max(furthest, std::abs(byte - curve(static_cast<double>(x))));
    });
    return furthest;
}

}  // namespace

TEST_CASE("a film is black until something is stored") {
    const candela::Film film(700, 500, candela::PixelType::byte, ColorEncoding::srgb);
    std::size_t sum = 0;
    for (const unsigned byte : film.view().bytes) sum += byte;
    CHECK(film.view().bytes.size() == std::size_t{3} * 700 * 500);
    CHECK(sum == 0);
}

TEST_CASE("a byte is the nearest to sRGB's curve, up to a few thousandths") {
    const double furthest = furthest_from(srgb_255, ColorEncoding::srgb);
    CHECK(furthest < 0.504);
    CHECK(furthest > 0.49);
}

TEST_CASE("a byte without a curve is the nearest to 255 times the intensity") {
    CHECK(furthest_from([](double x) { return 255 * x; }, ColorEncoding::none) < 0.50002);
}

TEST_CASE("intensities beyond black or white are clamped, and NaN becomes black") {
    constexpr float k_infinity = std::numeric_limits<float>::infinity();
    std::vector<float> odd;
    for (int i = 0; i < 200; ++i) {
        odd.insert(odd.end(), {-1.0f, -0.0f, -k_infinity, std::numeric_limits<float>::quiet_NaN(), 1e-40f,
                               1.0f, 1.0000001f, 3e38f, k_infinity});
    }
    for (const ColorEncoding encoding : {ColorEncoding::srgb, ColorEncoding::none})
        each_stored(odd, encoding, [](float x, int byte) { CHECK(byte == (x >= 1.0f ? 255 : 0)); });
}
