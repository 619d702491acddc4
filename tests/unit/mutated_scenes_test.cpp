// Thousands of damaged scenes, the same in every run: each is read or refused, every error has a position,
// and the messages are safe to print.
#include <algorithm>
#include <array>
#include <catch2/catch_test_macros.hpp>
#include <cstddef>
#include <filesystem>
#include <map>
#include <random>
#include <string>
#include <string_view>

#include "console/diagnostics_text.h"
#include "support/plugins.h"

import candela.core;

namespace {

constexpr std::string_view k_scene = R"(version = 1
[room]
height = 10.0
width = 10
[observer]
position = [0.0, 2.0, 4.5]
look_at = [0, 0.5, 0]
fov = 31.0
[image]
width = 64
height = 48
samples = 4
background = [24, 26, 34]
[shading]
model = "phong"
[reflection]
model = "blinn-phong"
[[light]]
name = "lamp"
type = "spot"
position = [-2.2, 3.4, 2.6]
direction = [0.5, -1.0, -0.25]
color = [255, 236, 208]
intensity = 19.0
inner_angle = 10
outer_angle = 35.5
[[light]]
type = "ambient"
[[object]]
name = "box"
type = "cube"
scale = [3.0, 0.1, 2]
color = [138, 150, 160]
reflection = "lambert"
[object.material]
kd = 0.8
[[object]]
name = 'ring'
type = "torus"
major_radius = 0.5
minor_radius = 0.17
position = [0, 1, 0]
rotation = [90, -25.0, 0]
)";

constexpr std::array<std::string_view, 30> k_pieces = {"\x1b[31m",
                                                       std::string_view("\0", 1),
                                                       "\xc2\x9b",
                                                       "\xe2\x80\xae",
                                                       "\xff",
                                                       "\xed\xa0\x80",
                                                       "\x7f",
                                                       "\r",
                                                       "\n",
                                                       "\"",
                                                       "'",
                                                       "\"\"\"",
                                                       "[",
                                                       "]",
                                                       "{",
                                                       "}",
                                                       "=",
                                                       ".",
                                                       "#",
                                                       "-",
                                                       "1e38",
                                                       "1e-45",
                                                       "1e400",
                                                       "nan",
                                                       "inf",
                                                       "0",
                                                       "99999999999999999999",
                                                       "255.0",
                                                       "\xc3\xa9",
                                                       "\\u202e"};

std::string mutated(std::mt19937& random) {
    const auto below = [&](std::size_t n) {
        return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
    };
    std::string text(k_scene);
    for (std::size_t i = 0, count = 1 + below(3); i < count; ++i) {
        const std::size_t at = below(text.size());
        switch (below(4)) {
            case 0:
                text[at] = static_cast<char>(below(256));
                break;
            case 1:
                text.insert(at, k_pieces[below(k_pieces.size())]);
                break;
            case 2:
                text.erase(at, 1 + below(20));
                break;
            default: {
                // Replaces a number, because numbers have most of the constraints.
                const std::size_t begin = std::min(text.find_first_of("0123456789", at), text.size());
                const std::size_t end = std::min(text.find_first_not_of("0123456789.", begin), text.size());
                text.replace(begin, end - begin, k_pieces[below(k_pieces.size())]);
            }
        }
    }
    return text;
}

/// Only errors about something missing have no position.
bool is_about_the_whole(const std::string& message) { return message.starts_with("the scene "); }

}  // namespace

TEST_CASE("of thousands of damaged scenes, every error has a position, and every message is printable text") {
    std::mt19937 random(15);
    std::size_t valid = 0, invalid = 0;
    for (int i = 0; i < 4000; ++i) {
        candela::SceneRequest request;
        request.files = {"-"};
        request.streams["-"] = mutated(random);
        INFO(request.streams["-"]);
        candela::Diagnostics diagnostics;
        const auto draft = candela::draft_scene(request, test_registry(), diagnostics);
        const auto compiled = draft ? candela::build(*draft, test_registry(), diagnostics) : std::nullopt;
        REQUIRE(compiled.has_value() == !diagnostics.has_errors());
        ++(compiled ? valid : invalid);
        for (const candela::Diagnostic& d : diagnostics.sorted()) {
            INFO(d.message);
            REQUIRE(d.place.file == "standard input");
            if (!is_about_the_whole(d.message)) REQUIRE(d.place.line > 0);
        }
        const std::string text = diagnostics_text(diagnostics, false);
        REQUIRE_FALSE(candela::first_invalid_byte(text));
        REQUIRE(candela::printable(text, candela::LineBreaks::kept) == text);
        const std::string json = diagnostics_json(diagnostics);
        REQUIRE(candela::printable(json, candela::LineBreaks::kept) == json);
    }
    CHECK(valid > 20);
    CHECK(invalid > 1000);
}
