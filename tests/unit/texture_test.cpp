// Mip maps against closed forms: levels are means of what they cover, and look-ups weight texels by area.
#include <array>
#include <catch2/catch_approx.hpp>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "support/plugins.h"

using candela::MipMap;
using candela::TextureWrap;
using candela::Vec3;
using Catch::Approx;

namespace {

using Shown = std::function<Vec3(int x, int y)>;

/// A map whose texels are the values of `shown`, of 65535.
MipMap mip_map(int width, int height, const Shown& shown) {
    MipMap::Texels texels;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const Vec3 color = shown(x, y);
            for (const float channel : {color.x, color.y, color.z})
                texels.push_back(static_cast<std::uint16_t>(channel));
        }
    }
    return {width, height, std::move(texels)};
}

/// A ramp from left to right in red and from top to bottom in green.
MipMap ramp(int size, int step) {
    return mip_map(size, size, [&](int x, int y) {
        return Vec3{static_cast<float>(step * x), static_cast<float>(step * y), 0};
    });
}

Vec3 texel(const MipMap& map, std::size_t level, int x, int y) {
    const MipMap::Level& l = map.levels()[level];
    const std::size_t i = 3 * (l.first + static_cast<std::size_t>(y * l.width + x));
    return {static_cast<float>(map.texels()[i]), static_cast<float>(map.texels()[i + 1]),
            static_cast<float>(map.texels()[i + 2])};
}

/// The values, of 1, at up to k_batch_size points.
std::vector<Vec3> values_at(const MipMap& map, const candela::TexturePlacing& placing, std::size_t count,
                            const candela::TextureCoordinates& at) {
    const std::shared_ptr<const MipMap> picture(&map, [](const MipMap*) {});
    candela::MaterialTextures textures{.textures = {{.picture = picture, .placing = placing}}};
    for (std::size_t c = 0; c < 3; ++c) textures.numbers.push_back({.texel_channel = c});
    std::vector<candela::AlignedVector<float>> channels(3, candela::AlignedVector<float>(count));
    candela::evaluate(textures, count, {.uv = {at}}, channels);
    std::vector<Vec3> values;
    for (std::size_t i = 0; i < count; ++i)
        values.push_back({channels[0][i], channels[1][i], channels[2][i]});
    return values;
}

/// The value at (u, v), of 65535, where a pixel is `texels` of the picture wide and high.
Vec3 seen(const MipMap& map, float u, float v, const candela::TexturePlacing& placing, float texels = 0) {
    const float dudx = texels / static_cast<float>(map.width()),
                dvdy = texels / static_cast<float>(map.height());
    constexpr float k_zero = 0;
    return 65535 * values_at(map, placing, 1, {{&u, &v}, {&dudx, &k_zero}, {&k_zero, &dvdy}})[0];
}

Vec3 seen(const MipMap& map, float u, float v, TextureWrap wrap = TextureWrap::repeat, float texels = 0) {
    return seen(map, u, v, candela::TexturePlacing{.wrap = wrap}, texels);
}

bool is_near(Vec3 a, Vec3 b, float tolerance = 0.02f) { return candela::length(a - b) < tolerance; }

/// The coordinates of a texel's centre.
float u_of(const MipMap& map, double x) { return static_cast<float>((x + 0.5) / map.width()); }
float v_of(const MipMap& map, double y) { return static_cast<float>(1 - (y + 0.5) / map.height()); }

}  // namespace

TEST_CASE("texture: a level's texel is the mean of the four that it covers, down to a single one") {
    const MipMap map = ramp(8, 100);
    REQUIRE(map.levels().size() == 4);
    // The mean of 2x and 2x + 1, of steps of 100, and so on.
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x)
            CHECK(texel(map, 1, x, y) ==
                  Vec3{200.0f * static_cast<float>(x) + 50, 200.0f * static_cast<float>(y) + 50, 0});
    CHECK(texel(map, 2, 1, 0) == Vec3{550, 150, 0});
    CHECK(texel(map, 3, 0, 0) == Vec3{350, 350, 0});
}

TEST_CASE("texture: levels of a checkerboard are grey") {
    const MipMap map = mip_map(64, 64, [](int x, int y) {
        const float on = (x + y) % 2 == 0 ? 60000.0f : 0.0f;
        return Vec3{on, on, on};
    });
    REQUIRE(map.levels().size() == 7);
    for (std::size_t level = 1; level < 7; ++level)
        CHECK(texel(map, level, 0, 0) == Vec3{30000, 30000, 30000});
}

TEST_CASE("texture: levels of odd sizes weight texels by their covered fraction") {
    // Three to one: each a third.
    const MipMap three = mip_map(3, 1, [](int x, int) { return Vec3{static_cast<float>(3000 * x), 0, 0}; });
    REQUIRE(three.levels().size() == 2);
    CHECK(texel(three, 1, 0, 0) == Vec3{3000, 0, 0});
    // Five to two: 1, 1 and a half of the third, of two and a half.
    const MipMap five = mip_map(5, 1, [](int x, int) { return Vec3{x == 2 ? 50000.0f : 0.0f, 0, 0}; });
    REQUIRE(five.levels().size() == 3);
    CHECK(texel(five, 1, 0, 0) == Vec3{10000, 0, 0});
    CHECK(texel(five, 1, 1, 0) == Vec3{10000, 0, 0});
    CHECK(texel(five, 2, 0, 0) == Vec3{10000, 0, 0});
}

TEST_CASE("texture: the mean of a picture is that of every level whose sizes are powers of two") {
    const MipMap map = mip_map(
        32, 8, [](int x, int y) { return Vec3{static_cast<float>((x * 37 + y * 101) % 256 * 256), 0, 0}; });
    double mean = 0;
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 32; ++x) mean += static_cast<double>(texel(map, 0, x, y).x) / 256;
    REQUIRE(map.levels().size() == 6);
    // Each level rounds to one of 65535.
    CHECK(texel(map, 5, 0, 0).x == Approx(mean).margin(3));
}

TEST_CASE("texture: a texel's centre has its value, and the point between two has their mean") {
    const MipMap map = ramp(8, 1000);
    CHECK(is_near(seen(map, u_of(map, 3), v_of(map, 5)), {3000, 5000, 0}));
    CHECK(is_near(seen(map, u_of(map, 3.5), v_of(map, 5)), {3500, 5000, 0}));
    CHECK(is_near(seen(map, u_of(map, 3.25), v_of(map, 0.75)), {3250, 750, 0}));
}

TEST_CASE("texture: v grows from the bottom of the picture to its top") {
    const MipMap map = ramp(8, 1000);
    CHECK(is_near(seen(map, 0.5f / 8, 7.5f / 8), {0, 0, 0}));
    CHECK(is_near(seen(map, 0.5f / 8, 0.5f / 8), {0, 7000, 0}));
}

TEST_CASE("texture: outside its edges it repeats, or continues the edge colours") {
    const MipMap map = ramp(8, 1000);
    const float v = v_of(map, 0);
    for (const float turn : {-3.0f, -1.0f, 1.0f, 20.0f}) {
        CHECK(is_near(seen(map, u_of(map, 3) + turn, v), {3000, 0, 0}, 0.2f));
        CHECK(is_near(seen(map, u_of(map, 3), v + turn), {3000, 0, 0}, 0.2f));
        CHECK(is_near(seen(map, u_of(map, 3) + turn, v, TextureWrap::clamp),
                      {turn > 0 ? 7000.0f : 0.0f, 0, 0}));
    }
    // On the seam: half of the first and half of the last.
    CHECK(is_near(seen(map, 0, v), {3500, 0, 0}));
    CHECK(is_near(seen(map, 1, v), {3500, 0, 0}));
    CHECK(is_near(seen(map, 0, v, TextureWrap::clamp), {0, 0, 0}));
    CHECK(is_near(seen(map, 1, v, TextureWrap::clamp), {7000, 0, 0}));
}

TEST_CASE("texture: mirrored, every other repetition is reversed, and seams have the colours of the edges") {
    const MipMap map = ramp(8, 1000);
    const float v = v_of(map, 0);
    for (const int turn : {-4, -3, -2, -1, 0, 1, 2, 7}) {
        INFO("repetition " << turn);
        const float shown = turn % 2 == 0 ? 2000.0f : 5000.0f;
        const float u = u_of(map, 2) + static_cast<float>(turn);
        CHECK(is_near(seen(map, u, v, TextureWrap::mirror), {shown, 0, 0}, 0.2f));
        // From the top row, v = 15 / 16, downwards.
        const float up = v + static_cast<float>(turn);
        CHECK(is_near(seen(map, u_of(map, 3), up, TextureWrap::mirror),
                      {3000, turn % 2 == 0 ? 0.0f : 7000.0f, 0}, 0.2f));
    }
    for (const float seam : {-2.0f, 0.0f, 2.0f, 6.0f})
        CHECK(is_near(seen(map, seam, v, TextureWrap::mirror), {0, 0, 0}, 0.2f));
    for (const float seam : {-1.0f, 1.0f, 3.0f})
        CHECK(is_near(seen(map, seam, v, TextureWrap::mirror), {7000, 0, 0}, 0.2f));
}

TEST_CASE("texture: along u it may continue in another way than along v") {
    using candela::TextureWrapV;
    const MipMap map = ramp(8, 1000);
    // One and a quarter to the right of the centre of texel (1, 5), and as far above it: u = 1 + 7 / 16 and
    // v = 1 + 9 / 16. Repeated, that is texel (3, 3); clamped, (7, 0); and in a mirror, where u = 9 / 16 and
    // v = 7 / 16, (4, 4).
    struct Way {
        TextureWrap wrap;
        TextureWrapV wrap_v;
        float column, row;
    };
    for (const Way& way : {Way{TextureWrap::repeat, TextureWrapV::clamp, 3, 0},
                           Way{TextureWrap::clamp, TextureWrapV::repeat, 7, 3},
                           Way{TextureWrap::mirror, TextureWrapV::repeat, 4, 3},
                           Way{TextureWrap::repeat, TextureWrapV::mirror, 3, 4},
                           Way{TextureWrap::clamp, TextureWrapV::mirror, 7, 4},
                           Way{TextureWrap::mirror, TextureWrapV::clamp, 4, 0},
                           Way{TextureWrap::mirror, TextureWrapV::same, 4, 4}}) {
        INFO(static_cast<int>(way.wrap) << ", " << static_cast<int>(way.wrap_v));
        const candela::TexturePlacing placing{.wrap = way.wrap, .wrap_v = way.wrap_v};
        const Vec3 expected{1000 * way.column, 1000 * way.row, 0};
        CHECK(is_near(seen(map, u_of(map, 1) + 1.25f, v_of(map, 5) + 1.25f, placing), expected, 0.2f));
        const candela::PlacedTexture placed{
            .picture = std::shared_ptr<const MipMap>(&map, [](const MipMap*) {}), .placing = placing};
        CHECK(placed.texel_at(u_of(map, 1) + 1.25f, v_of(map, 5) + 1.25f) ==
              std::array{static_cast<int>(way.column), static_cast<int>(way.row)});
    }
}

TEST_CASE(
    "texture: a pixel that covers two texels sees the next level, and one that covers all sees their mean") {
    const MipMap map = ramp(8, 1000);
    // The centre of texel 1 of level 1 lies between texels 2 and 3.
    CHECK(is_near(seen(map, u_of(map, 2.5), v_of(map, 2.5), TextureWrap::repeat, 2), {2500, 2500, 0}));
    CHECK(is_near(seen(map, u_of(map, 0), v_of(map, 0), TextureWrap::repeat, 8), {3500, 3500, 0}));
    CHECK(is_near(seen(map, u_of(map, 0), v_of(map, 0), TextureWrap::repeat, 1e9f), {3500, 3500, 0}));
    // Less than a texel: no filtering.
    CHECK(is_near(seen(map, u_of(map, 2), v_of(map, 2), TextureWrap::repeat, 0.1f), {2000, 2000, 0}));
}

TEST_CASE("texture: between two levels the logarithm of the footprint blends them") {
    const MipMap map = mip_map(4, 4, [](int x, int y) { return Vec3{x + y == 0 ? 64000.0f : 0.0f, 0, 0}; });
    // At the centre of the first texel of level 1, whose value is 16000. In level 0 the four around it have
    // that mean as well, in level 2 all have 4000.
    const float u = u_of(map, 0.5), v = v_of(map, 0.5);
    for (const double detail : {1.0, 1.25, 1.5, 1.9, 2.0}) {
        const auto texels = static_cast<float>(std::exp2(detail));
        const double expected = 16000 + (detail - 1) * (4000 - 16000);
        INFO("level " << detail);
        CHECK(is_near(seen(map, u, v, TextureWrap::clamp, texels), {static_cast<float>(expected), 0, 0}, 2));
    }
}

TEST_CASE("texture: the longer side of a footprint decides, in any orientation") {
    const MipMap map = ramp(8, 1000);
    const float u = u_of(map, 2.5), v = v_of(map, 2.5), zero = 0;
    const float two = 2.0f / 8, diagonal = 2.0f / 8 / std::sqrt(2.0f);
    const auto with = [&](std::array<float, 4> d) {
        const candela::TextureCoordinates at{{&u, &v}, {&d[0], &d[1]}, {&d[2], &d[3]}};
        return 65535 * values_at(map, {}, 1, at)[0];
    };
    CHECK(is_near(with({two, zero, zero, zero}), {2500, 2500, 0}));
    CHECK(is_near(with({zero, zero, zero, two}), {2500, 2500, 0}));
    CHECK(is_near(with({diagonal, -diagonal, zero, zero}), {2500, 2500, 0}, 0.5f));
}

TEST_CASE("texture: it is looked up point by point, for any number of points") {
    const MipMap map = ramp(8, 8000);
    std::vector<float> u(candela::k_batch_size), v(candela::k_batch_size, v_of(map, 1)),
        zero(candela::k_batch_size);
    for (std::size_t i = 0; i < u.size(); ++i) u[i] = u_of(map, static_cast<double>(i % 8));
    const candela::ConstVec2Span none{zero.data(), zero.data()};
    for (std::size_t count = 1; count <= u.size(); ++count) {
        const auto values = values_at(map, {}, count, {{u.data(), v.data()}, none, none});
        for (std::size_t i = 0; i < count; ++i) {
            REQUIRE(values[i].x == Approx(8000 * static_cast<double>(i % 8) / 65535).margin(1e-6));
            REQUIRE(values[i].y == Approx(8000.0 / 65535).margin(1e-6));
            REQUIRE(values[i].z == 0);
        }
    }
}

TEST_CASE("texture: non-finite coordinates and footprints show some texel") {
    const MipMap map = mip_map(4, 4, [](int, int) { return Vec3{20000, 20000, 20000}; });
    for (const float odd : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                            -std::numeric_limits<float>::infinity(), 1e30f, -1e30f}) {
        for (const TextureWrap wrap : {TextureWrap::repeat, TextureWrap::clamp, TextureWrap::mirror}) {
            CHECK(is_near(seen(map, odd, 0.5f, wrap), {20000, 20000, 20000}, 1));
            CHECK(is_near(seen(map, 0.5f, odd, wrap), {20000, 20000, 20000}, 1));
            CHECK(is_near(seen(map, 0.5f, 0.5f, wrap, odd), {20000, 20000, 20000}, 1));
        }
    }
}

TEST_CASE("texture: all instruction sets agree within a thousandth of a byte's step") {
    const MipMap map = mip_map(16, 16, [](int x, int y) {
        return Vec3{static_cast<float>((x * 7919 + y * 104729) % 65536), static_cast<float>(x * 4000), 0};
    });
    const candela::InstructionSet before = candela::instruction_set();
    std::vector<Vec3> first;
    for (const candela::InstructionSet set : machine_instruction_sets()) {
        REQUIRE(candela::use_instruction_set(set));
        std::vector<Vec3> all;
        for (int i = 0; i < 200; ++i) {
            const auto at = static_cast<float>(i);
            all.push_back(seen(map, 0.0137f * at, 0.0291f * at, TextureWrap::repeat, 0.05f * at));
        }
        if (first.empty()) first = all;
        for (std::size_t i = 0; i < all.size(); ++i) REQUIRE(is_near(all[i], first[i], 0.25f));
    }
    candela::use_instruction_set(before);
}
