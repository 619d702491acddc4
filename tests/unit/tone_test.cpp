// Exposure and tone curves of 8-bit pictures, against the curves' publications in double precision.
#include <algorithm>
#include <array>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <cstddef>
#include <functional>
#include <random>
#include <vector>

#include "support/samples.h"

namespace {

using candela::ColorEncoding;
using candela::DisplayTransform;
using candela::ToneCurve;
using Color = std::array<double, 3>;
/// Three columns, as GLSL writes matrices.
using Columns = std::array<Color, 3>;

Color times(const Columns& m, const Color& c) {
    Color result{};
    for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t k = 0; k < 3; ++k) result[row] += m[k][row] * c[k];
    return result;
}

template <class Function>
Color each(Color c, Function f) {
    for (double& x : c) x = f(x);
    return c;
}

double least(const Color& c) { return *std::ranges::min_element(c); }
double most(const Color& c) { return *std::ranges::max_element(c); }

/// Khronos PBR Neutral Tone Mapper, specification 1.0, section "GLSL code".
Color khronos_neutral(Color c) {
    constexpr double k_start = 0.8 - 0.04, k_desaturation = 0.15;
    const double x = least(c), offset = x < 0.08 ? x - 6.25 * x * x : 0.04;
    for (double& channel : c) channel -= offset;
    const double peak = most(c);
    if (peak < k_start) return c;
    const double d = 1 - k_start, new_peak = 1 - d * d / (peak + d - k_start);
    const double g = 1 - 1 / (k_desaturation * (peak - new_peak) + 1);
    return each(c, [&](double v) { return (1 - g) * v * new_peak / peak + g * new_peak; });
}

/// Stephen Hill, "ACES.hlsl" in MJP's BakingLab; its matrices are written in rows.
Color aces(const Color& c) {
    const Columns input{
        {{0.59719, 0.07600, 0.02840}, {0.35458, 0.90834, 0.13383}, {0.04823, 0.01566, 0.83777}}};
    const Columns output{
        {{1.60475, -0.10208, -0.00327}, {-0.53108, 1.10813, -0.07276}, {-0.07367, -0.00605, 1.07602}}};
    return times(output, each(times(input, c), [](double v) {
                     return (v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.4329510) + 0.238081);
                 }));
}

/// AgX as in three.js r170, tonemapping_pars_fragment.glsl.js, before its last clamp.
Color agx(const Color& c) {
    const Columns to_rec2020{{{0.6274, 0.0691, 0.0164}, {0.3293, 0.9195, 0.0880}, {0.0433, 0.0113, 0.8956}}};
    const Columns from_rec2020{
        {{1.6605, -0.1246, -0.0182}, {-0.5876, 1.1329, -0.1006}, {-0.0728, -0.0083, 1.1187}}};
    const Columns inset{{{0.856627153315983, 0.137318972929847, 0.11189821299995},
                         {0.0951212405381588, 0.761241990602591, 0.0767994186031903},
                         {0.0482516061458583, 0.101439036467562, 0.811302368396859}}};
    const Columns outset{{{1.1271005818144368, -0.1413297634984383, -0.14132976349843826},
                          {-0.11060664309660323, 1.157823702216272, -0.11060664309660294},
                          {-0.016493938717834573, -0.016493938717834257, 1.2519364065950405}}};
    constexpr double k_low = -12.47393, k_high = 4.026069;
    Color v = times(inset, times(to_rec2020, c));
    v = each(v, [](double x) {
        const double t = std::clamp((std::log2(std::max(x, 1e-10)) - k_low) / (k_high - k_low), 0.0, 1.0);
        return 15.5 * std::pow(t, 6) - 40.14 * std::pow(t, 5) + 31.96 * std::pow(t, 4) -
               6.868 * std::pow(t, 3) + 0.4298 * t * t + 0.1191 * t - 0.00232;
    });
    v = each(times(outset, v), [](double x) { return std::pow(std::max(x, 0.0), 2.2); });
    return times(from_rec2020, v);
}

/// Reinhard et al. 2002, equation 3.
Color reinhard(const Color& c) {
    return each(c, [](double x) { return x / (1 + x); });
}

struct Curve {
    ToneCurve tone;
    std::function<Color(const Color&)> published;
    double tolerance;
};
const std::vector<Curve>& curves() {
    // AgX's polynomial and its power multiply the rounding of the logarithm.
    static const std::vector<Curve> k_all = {{ToneCurve::khronos_neutral, khronos_neutral, 2e-6},
                                             {ToneCurve::aces, aces, 2e-6},
                                             {ToneCurve::agx, agx, 4e-5},
                                             {ToneCurve::reinhard, reinhard, 1e-6}};
    return k_all;
}

/// Colours from very dark to very bright, saturated ones included.
std::vector<candela::Rgb> colors() {
    std::mt19937 random(2052);
    std::uniform_real_distribution<float> exponent(-12, 8), unit(0, 1);
    std::vector<candela::Rgb> all = {{0, 0, 0}, {0.18f, 0.18f, 0.18f}, {1, 1, 1}, {1, 0, 0}, {100, 0, 50}};
    while (all.size() < 20000) {
        const float scale = std::exp2(exponent(random));
        const auto channel = [&] { return unit(random) < 0.1f ? 0.0f : scale * unit(random); };
        all.push_back({channel(), channel(), channel()});
    }
    return all;
}

}  // namespace

TEST_CASE("tone curves are their publications', with every instruction set") {
    each_way([&](std::size_t) {
        for (const Curve& curve : curves()) {
            double furthest = 0;
            for (const candela::Rgb& c : colors()) {
                const candela::Rgb shown = candela::toned(c, {ColorEncoding::none, 1, curve.tone});
                const Color expected = curve.published({double{c.r}, double{c.g}, double{c.b}});
                const Color found{double{shown.r}, double{shown.g}, double{shown.b}};
                for (std::size_t k = 0; k < 3; ++k)
                    furthest = std::max(furthest, std::abs(found[k] - expected[k]));
            }
            INFO("curve " << static_cast<int>(curve.tone));
            CHECK(furthest < curve.tolerance);
        }
    });
}

TEST_CASE(
    "an exposed film's bytes are those of its pixels' displayed values, whatever their number in a row") {
    const std::vector<candela::Rgb> all = colors();
    std::vector<float> r, g, b;
    for (const candela::Rgb& c : all) {
        r.push_back(c.r);
        g.push_back(c.g);
        b.push_back(c.b);
    }
    for (const ToneCurve tone : {ToneCurve::none, ToneCurve::khronos_neutral, ToneCurve::aces, ToneCurve::agx,
                                 ToneCurve::reinhard}) {
        const DisplayTransform transform(ColorEncoding::srgb, 0.3f, tone);
        each_way([&](std::size_t columns) {
            const auto width = static_cast<int>(columns);
            const auto height = static_cast<int>(all.size() / columns);
            candela::Film film(width, height, candela::PixelType::byte, transform);
            film.store(0, 0, width, height, {r.data(), g.data(), b.data()}, width);
            float furthest = 0;
            for (std::size_t i = 0; i < film.view().bytes.size() / 3; ++i) {
                const candela::Rgb shown = candela::displayed(all[i], transform);
                const std::array<float, 3> channels{shown.r, shown.g, shown.b};
                for (std::size_t k = 0; k < 3; ++k)
                    furthest = std::max(furthest, std::abs(255 * channels[k] -
                                                           static_cast<float>(film.view().bytes[3 * i + k])));
            }
            CHECK(furthest < 0.51f);
        });
    }
}

TEST_CASE("a film of floats keeps intensities, whatever the exposure and tone") {
    const float bright = 1e4f;
    candela::Film film(1, 1, candela::PixelType::real, {ColorEncoding::srgb, 0.001f, ToneCurve::agx});
    film.store(0, 0, 1, 1, {&bright, &bright, &bright}, 1);
    CHECK(film.view().reals[0] == bright);
}

TEST_CASE("the exposure factor is one over 1.2 times two to the exposure value") {
    CHECK(candela::exposure_factor(candela::k_unexposed) == 1);
    for (const float ev : {-24.0f, -3.5f, 0.0f, 12.0f, 24.0f}) {
        const double expected = 1 / (1.2 * std::exp2(double{ev}));
        CHECK(std::abs(double{candela::exposure_factor(ev)} / expected - 1) < 1e-6);
    }
    CHECK(std::abs(1.2 * std::exp2(double{candela::k_unexposed}) - 1) < 1e-7);
}
