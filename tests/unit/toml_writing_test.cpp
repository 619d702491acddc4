#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "console/diagnostics_text.h"

import candela.core;
import candela.scene;

namespace {

/// A value, read by toml++.
template <class T>
T read_back(const std::string& value) {
    candela::Diagnostics diagnostics;
    const auto node = candela::parse_value(value, {}, diagnostics);
    INFO(value << " " << diagnostics_text(diagnostics, false));
    REQUIRE(node);
    return std::get<T>(node->value);
}

std::string read_back_text(const std::string& text) {
    return read_back<std::string>(candela::toml_text(std::string_view(text)));
}

}  // namespace

TEST_CASE("strings come back from TOML unchanged, with every character") {
    for (int c = 0; c < 128; ++c) {
        INFO("character " << c);
        CHECK(read_back_text("a" + std::string(1, static_cast<char>(c)) + "b") ==
              "a" + std::string(1, static_cast<char>(c)) + "b");
    }
    for (const char* const text : {"", "é", "日本語", "🫖", "\xc2\x85", "\xed\x9f\xbf", "\xee\x80\x80",
                                   "\xf4\x8f\xbf\xbf", R"(\u0041)", R"(""")", R"(''' \)", "a\r\nb"}) {
        CHECK(read_back_text(text) == text);
    }
    // Unicode 15, section 3.9: truncated, overlong, a surrogate, beyond the last code point, an invalid lead
    // byte.
    for (const char* const text : {"\xc3", "\xe6\x97", "\xc0\x80", "\xe0\x80\x80", "\xed\xa0\x80",
                                   "\xf4\x90\x80\x80", "\x80", "\xff", "\xf0\x8f\xbf\xbf", "a\xe9z"}) {
        CHECK_THROWS_AS(candela::toml_text(std::string_view(text)), candela::Error);
    }
}

TEST_CASE("numbers come back from TOML unchanged, to the last bit") {
    std::mt19937_64 random(7);
    for (int i = 0; i < 200'000; ++i) {
        const std::uint64_t bits = random();
        const auto low = static_cast<std::uint32_t>(bits);
        float f = 0;
        std::memcpy(&f, &low, sizeof f);
        double d = 0;
        std::memcpy(&d, &bits, sizeof d);
        if (std::isfinite(f)) REQUIRE(static_cast<float>(std::stod(candela::toml_text(f))) == f);
        // strtod() calls a subnormal number out of range, though it reads it.
        if (std::isnormal(d)) REQUIRE(std::stod(candela::toml_text(d)) == d);
    }
    using Double = std::numeric_limits<double>;
    using Float = std::numeric_limits<float>;
    for (const double d :
         {0.0, -0.0, 1.0, 0.1, 1e16, 1e-7, 123456789.0, Double::min(), Double::max(), 1e-310}) {
        const auto read = read_back<double>(candela::toml_text(d));
        CHECK(read == d);
        CHECK(std::signbit(read) == std::signbit(d));
    }
    for (const float f : {0.1f, 1e10f, 16777216.0f, Float::min(), Float::denorm_min(), Float::max(), -1.5f}) {
        CHECK(static_cast<float>(read_back<double>(candela::toml_text(f))) == f);
    }
    CHECK(candela::toml_text(0.1f) == "0.1");
    CHECK(candela::toml_text(2.0) == "2.0");
    CHECK_THROWS_AS(candela::toml_text(Double::infinity()), candela::Error);
    CHECK_THROWS_AS(candela::toml_text(Float::quiet_NaN()), candela::Error);
    CHECK(candela::toml_key("shininess_2-a") == "shininess_2-a");
    CHECK(candela::toml_key("two words") == "\"two words\"");
}
