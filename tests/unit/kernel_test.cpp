#include <candela/kernel/kernel.h>

#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

namespace k = candela::kernel;

namespace {

constexpr int k_points = 200000;

/// The largest error over [low, high], relative to max(|exact|, floor).
template <class Approximate, class Exact>
double worst(double low, double high, double floor, Approximate approximate, Exact exact) {
    double error = 0;
    for (int i = 0; i <= k_points; ++i) {
        const auto x = static_cast<float>(low + (high - low) * i / k_points);
        const double expected = exact(static_cast<double>(x));
        error = std::max(error, std::abs(static_cast<double>(approximate(x)) - expected) /
                                    std::max(std::abs(expected), floor));
    }
    return error;
}

}  // namespace

TEST_CASE("kernel powers and logarithms agree with double precision to a few units in the last place") {
    CHECK(
        worst(-99, 99, 0, [](float x) { return k::exp2(x); }, [](double x) { return std::exp2(x); }) < 3e-7);
    CHECK(worst(
              1e-6, 4, 1e-2, [](float x) { return k::log2(x); }, [](double x) { return std::log2(x); }) <
          5e-7);
    CHECK(worst(-30, 30, 0, [](float x) { return k::exp(x); }, [](double x) { return std::exp(x); }) < 3e-6);
    CHECK(worst(
              0.01, 100, 1e-2, [](float x) { return k::log(x); }, [](double x) { return std::log(x); }) <
          5e-7);
}

TEST_CASE(
    "kernel inversesqrt agrees with double precision to a few units in the last place, and stays finite") {
    const auto exact = [](double x) { return 1 / std::sqrt(x); };
    for (int exponent = -126; exponent < 127; ++exponent) {
        INFO("from 2^" << exponent);
        const double low = std::ldexp(1.0, exponent);
        CHECK(worst(low, 2 * low, 0, [](float x) { return k::inversesqrt(x); }, exact) < 2e-7);
    }
    CHECK(std::isfinite(k::inversesqrt(0.0f)));
    CHECK(std::isfinite(k::inversesqrt(std::numeric_limits<float>::infinity())));
}

TEST_CASE("kernel pow agrees with double precision for every shininess in use") {
    for (const double y : {0.5, 1.0, 2.0, 10.0, 32.0, 150.0, 1000.0}) {
        INFO("exponent " << y);
        const auto exponent = static_cast<float>(y);
        CHECK(worst(
                  0.5, 1, 1e-6, [&](float x) { return k::pow(x, exponent); },
                  [&](double x) { return std::pow(x, y); }) < 3e-7 * (y + 2));
    }
}

TEST_CASE("kernel pow keeps zero and one exact, and stays out of the denormal range") {
    CHECK(k::pow(0.3f, 0.0f) == 1.0f);
    CHECK(k::pow(0.0f, 0.0f) == 1.0f);
    CHECK(k::pow(1.0f, 1234.5f) == 1.0f);
    CHECK(k::pow(0.0f, 10.0f) < 1e-30f);
    for (const float base : {0.0f, 1e-30f, 0.01f, 0.5f}) {
        const float power = k::pow(base, 5000.0f);
        CHECK(std::isnormal(power));
        CHECK(power < 1e-29f);
    }
    CHECK(std::isfinite(k::exp2(1e9f)));
    for (const float exponent : {0.001f, 0.01f, 0.1f, 2.0f}) CHECK(k::clamped_power(-0.5f, exponent) == 0.0f);
    CHECK(std::abs(k::clamped_power(0.5f, 0.01f) - std::pow(0.5, 0.01)) < 1e-6);
    CHECK(k::clamped_power(-0.5f, 0.0f) == 1.0f);
    // The least non-zero result leaves room for small factors before a product is denormal.
    CHECK(k::clamped_power(0.9f, 400.0f) > 1e-19f);
    CHECK(k::clamped_power(0.9f, 1000.0f) == 0.0f);
}

TEST_CASE("kernel angles agree with double precision") {
    constexpr double k_pi = std::numbers::pi;
    CHECK(worst(-20, 20, 1, [](float x) { return k::sin(x); }, [](double x) { return std::sin(x); }) < 3e-7);
    CHECK(worst(-20, 20, 1, [](float x) { return k::cos(x); }, [](double x) { return std::cos(x); }) < 3e-7);
    CHECK(
        worst(-1.4, 1.4, 1, [](float x) { return k::tan(x); }, [](double x) { return std::tan(x); }) < 1e-6);
    CHECK(worst(-1, 1, 1, [](float x) { return k::asin(x); }, [](double x) { return std::asin(x); }) < 5e-7);
    CHECK(worst(-1, 1, 1, [](float x) { return k::acos(x); }, [](double x) { return std::acos(x); }) < 5e-7);
    CHECK(
        worst(-50, 50, 1, [](float x) { return k::atan(x); }, [](double x) { return std::atan(x); }) < 5e-7);
    for (int i = 0; i < 360; ++i) {
        const double angle = (i + 0.5) * k_pi / 180 - k_pi;
        const auto y = static_cast<float>(std::sin(angle)), x = static_cast<float>(std::cos(angle));
        CHECK(std::abs(static_cast<double>(k::atan(y, x)) - std::atan2(y, x)) < 5e-7);
    }
    CHECK(k::cos(0.0f) == 1.0f);
    CHECK(k::acos(1.5f) == 0.0f);
}

TEST_CASE("kernel rounding follows GLSL") {
    for (const float x :
         {-2.5f, -2.0f, -1.2f, -0.0f, 0.0f, 0.3f, 0.5f, 0.99f, 1.0f, 7.5f, 123456.7f, 1e10f, -1e10f}) {
        INFO(x);
        CHECK(k::floor(x) == std::floor(x));
        CHECK(k::ceil(x) == std::ceil(x));
        CHECK(k::trunc(x) == std::trunc(x));
        CHECK(k::fract(x) == x - std::floor(x));
    }
    CHECK(k::mod(7.5f, 2.0f) == 1.5f);
    CHECK(k::mod(-1.0f, 3.0f) == 2.0f);
    CHECK(k::step(0.5f, 0.5f) == 1.0f);
    CHECK(k::smoothstep(0.0f, 2.0f, 1.0f) == 0.5f);
    CHECK(k::mix(2.0f, 4.0f, 0.25f) == 2.5f);
}

TEST_CASE("kernel vectors: reflect is T1 with the incident direction, normalize survives zero") {
    const k::vec3 r = k::reflect(k::vec3(1.0f, -1.0f, 0.0f), k::vec3(0.0f, 1.0f, 0.0f));
    CHECK(r.x == 1.0f);
    CHECK(r.y == 1.0f);
    const k::vec3 zero = k::normalize(k::vec3(0.0f));
    CHECK(zero.x == 0.0f);
    CHECK(std::abs(k::length(k::normalize(k::vec3(1e-10f, 2e-10f, -3e-10f))) - 1.0f) < 1e-6f);
    CHECK(k::cross(k::vec3(1.0f, 0.0f, 0.0f), k::vec3(0.0f, 1.0f, 0.0f)).z == 1.0f);
}

namespace {

void check_equal(k::vec4 a, k::vec4 b) {
    CHECK(a.x == b.x);
    CHECK(a.y == b.y);
    CHECK(a.z == b.z);
    CHECK(a.w == b.w);
}

}  // namespace

TEST_CASE("kernel functions of vectors are those of numbers, component by component") {
    const k::vec4 a(-1.75f, 0.25f, 2.5f, 0.0f), b(0.5f, 0.75f, 2.0f, 1.0f);
    check_equal(k::floor(a), k::vec4(-2.0f, 0.0f, 2.0f, 0.0f));
    check_equal(k::trunc(a), k::vec4(-1.0f, 0.0f, 2.0f, 0.0f));
    check_equal(k::fract(a), k::vec4(0.25f, 0.25f, 0.5f, 0.0f));
    check_equal(k::sign(a), k::vec4(-1.0f, 1.0f, 1.0f, 0.0f));
    check_equal(k::step(b, a), k::vec4(0.0f, 0.0f, 1.0f, 0.0f));
    check_equal(k::step(0.25f, a), k::vec4(0.0f, 1.0f, 1.0f, 0.0f));
    check_equal(k::mod(a, 2.0f), k::vec4(0.25f, 0.25f, 0.5f, 0.0f));
    check_equal(k::max(a, 0.0f), k::vec4(0.0f, 0.25f, 2.5f, 0.0f));
    check_equal(k::clamp(a, k::vec4(0.0f), b), k::vec4(0.0f, 0.25f, 2.0f, 0.0f));
    check_equal(k::mix(a, b, k::vec4(0.0f, 1.0f, 0.5f, 1.0f)), k::vec4(-1.75f, 0.75f, 2.25f, 1.0f));
    check_equal(k::sin(a), k::vec4(k::sin(-1.75f), k::sin(0.25f), k::sin(2.5f), 0.0f));
    check_equal(k::smoothstep(0.0f, 1.0f, a), k::vec4(0.0f, k::smoothstep(0.0f, 1.0f, 0.25f), 1.0f, 0.0f));
    CHECK(k::length(k::vec4(2.0f, 4.0f, 5.0f, 6.0f)) == 9.0f);
    CHECK(std::abs(k::length(k::normalize(k::vec2(3.0f, -4.0f))) - 1.0f) < 1e-6f);
}

TEST_CASE("kernel swizzles read the components that they name, and take no space") {
    const k::vec4 v(1.0f, 2.0f, 3.0f, 4.0f);
    const k::vec3 three = v.wyx;
    check_equal(v.wzyx, k::vec4(4.0f, 3.0f, 2.0f, 1.0f));
    check_equal(k::vec4(three.zy, three.yz), k::vec4(1.0f, 2.0f, 2.0f, 1.0f));
    check_equal(k::vec4(2.0f * v.xyz, 0.0f), k::vec4(2.0f, 4.0f, 6.0f, 0.0f));
    CHECK(k::dot(v.xy, v.zw) == 11.0f);
    CHECK((v + v).yx.operator k::vec2().x == 4.0f);
    STATIC_CHECK(sizeof(k::vec2) == 8);
    STATIC_CHECK(sizeof(k::vec3) == 12);
    STATIC_CHECK(sizeof(k::vec4) == 16);
    STATIC_CHECK(sizeof(k::mat3) == 36);
}

TEST_CASE("kernel matrices have columns, as in GLSL") {
    const k::mat3 m(k::vec3(1.0f, 2.0f, 3.0f), k::vec3(0.0f, 1.0f, 4.0f), k::vec3(5.0f, 6.0f, 0.0f));
    check_equal(k::vec4(m * k::vec3(1.0f, 10.0f, 100.0f), 0.0f), k::vec4(501.0f, 612.0f, 43.0f, 0.0f));
    check_equal(k::vec4(k::vec3(1.0f, 10.0f, 100.0f) * m, 0.0f), k::vec4(321.0f, 410.0f, 65.0f, 0.0f));
    check_equal(k::vec4(k::transpose(m)[0], m[2].y), k::vec4(1.0f, 0.0f, 5.0f, 6.0f));
    CHECK(k::determinant(m) == 1.0f);
    const k::mat3 one = m * k::inverse(m);
    check_equal(k::vec4(one[1], one[2].z), k::vec4(0.0f, 1.0f, 0.0f, 1.0f));
}

namespace {

template <std::size_t count>
k::Table table_of(const float (&numbers)[count]) {
    k::Table table;
    table.numbers = numbers;
    table.count = static_cast<int>(count);
    return table;
}

}  // namespace

TEST_CASE("a kernel reads only a table's own memory, whatever the index, and 0 if it is empty") {
    constexpr float k_numbers[] = {3, 5, 4};
    const k::Table table = table_of(k_numbers);
    CHECK(k::table_size(table) == 3);
    CHECK(k::table_at(table, 1) == 5);
    for (const int low : {0, -1, std::numeric_limits<int>::min()}) CHECK(k::table_at(table, low) == 3);
    for (const int high : {2, 3, std::numeric_limits<int>::max()}) CHECK(k::table_at(table, high) == 4);
    CHECK(k::table_size(k::Table()) == 0);
    for (const int i : {-1, 0, 1}) CHECK(k::table_at(k::Table(), i) == 0);
    CHECK(k::table_lookup(k::Table(), 0.5f) == 0);
}

TEST_CASE("a table is interpolated from its first number at 0 to its last at 1, and constant outside") {
    constexpr float k_numbers[] = {3, 5, 4};
    const k::Table table = table_of(k_numbers);
    CHECK(k::table_lookup(table, 0.0f) == 3);
    CHECK(k::table_lookup(table, 0.25f) == 4);
    CHECK(k::table_lookup(table, 0.5f) == 5);
    CHECK(k::table_lookup(table, 0.75f) == 4.5f);
    CHECK(k::table_lookup(table, 1.0f) == 4);
    CHECK(k::table_lookup(table, -7.0f) == 3);
    CHECK(k::table_lookup(table, 7.0f) == 4);
}

TEST_CASE("a grid in a table is interpolated between its columns and rows, and constant outside its edge") {
    constexpr float k_numbers[] = {-1, 0, 1, 2, 10, 20, 30};  // two rows of three, after one number
    const k::Table table = table_of(k_numbers);
    const auto at = [&](float x, float y) { return k::table_lookup_grid(table, 1, 3, 2, x, y); };
    CHECK(at(0, 0) == 0);
    CHECK(at(2, 1) == 30);
    CHECK(at(0.5f, 0) == 0.5f);
    CHECK(at(1, 0.5f) == 10.5f);
    CHECK(at(-3, 9) == 10);
    CHECK(at(9, -3) == 2);
}

TEST_CASE("the members of a struct with tables have no padding between them, so that each can be found") {
    struct Params {
        float a;
        k::Table b;
        k::mat3 c;
        k::Table d;
        int e;
    };
    STATIC_CHECK(sizeof(Params) == 2 * sizeof(float) + 2 * sizeof(k::Table) + sizeof(k::mat3));
}
