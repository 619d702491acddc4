#include <fmt/format.h>

#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "support/command.h"
#include "support/plugins.h"
#include "support/samples.h"

using candela::Light;
using candela::Vec3;

namespace {

constexpr double k_pi = std::numbers::pi;
constexpr const char* k_header = "IESNA:LM-63-2002\n[TEST] none\n";

std::string written(const std::string& text) {
    const std::filesystem::path path = scratch_directory() / "lamp.ies";
    std::ofstream(path, std::ios::binary) << text;
    return path.string();
}

std::vector<double> steps(double first, double last, int count) {
    std::vector<double> result;
    for (int i = 0; i <= count; ++i) result.push_back(first + (last - first) * i / count);
    return result;
}

using Candela = std::function<double(double v, double h)>;  // of angles in degrees

/// A photometric file; `scale` is its multiplier and two factors.
std::string file_of(const std::vector<double>& vertical, const std::vector<double>& horizontal,
                    const Candela& candela, const std::string& header = k_header,
                    const std::string& multiplier = "1", const std::string& factors = "1 1 50") {
    std::string text = fmt::format("{}TILT=NONE\n1 -1 {} {} {} 1 2 0 0 0\n{}\n", header, multiplier,
                                   vertical.size(), horizontal.size(), factors);
    for (const auto* const list : {&vertical, &horizontal}) {
        for (const double angle : *list) text += fmt::format("{:g} ", angle);
        text += '\n';
    }
    for (const double h : horizontal) {
        for (const double v : vertical) text += fmt::format("{:.9g}\n", candela(v, h));
    }
    return text;
}

std::unique_ptr<Light> lamp(const std::string& text, Vec3 axis = {0, -1, 0}, double rotation = 0) {
    return instance<Light>(
        "ies",
        {{"file", written(text)}, {"position", Vec3{0, 0, 0}}, {"direction", axis}, {"rotation", rotation}});
}

/// The candela that a lamp sends in a direction: pi times the light that arrives a metre away.
double sent(const Light& light, Double3 towards) {
    const Double3 d = unit(towards);
    return k_pi * static_cast<double>(illuminate(light, {{static_cast<float>(d.x), static_cast<float>(d.y),
                                                          static_cast<float>(d.z)}})[0]
                                          .diffuse.x);
}

/// The direction at these angles of a lamp that points down: 0 degrees around is +x, and 90 is -z.
Double3 at(double v, double h) {
    const double theta = v * k_pi / 180, phi = h * k_pi / 180;
    return {std::sin(theta) * std::cos(phi), -std::cos(theta), -std::sin(theta) * std::sin(phi)};
}

double flux(const Light& light) {
    double sum = 0;
    constexpr int k_rings = 360, k_spokes = 36;
    for (int i = 0; i < k_rings; ++i) {
        const double v = (i + 0.5) * 180 / k_rings;
        const double solid_angle =
            (std::cos(i * k_pi / k_rings) - std::cos((i + 1) * k_pi / k_rings)) * 2 * k_pi / k_spokes;
        for (int j = 0; j < k_spokes; ++j)
            sum += solid_angle * sent(light, at(v, (j + 0.5) * 360 / k_spokes));
    }
    return sum;
}

std::string refusal_of(const std::string& text) {
    try {
        lamp(text);
    } catch (const candela::Error& problem) {
        return problem.what();
    }
    return "";
}

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("light/ies: an even lamp of I candela has 4 pi I lumens, and is light/point of I / pi") {
    const auto even = lamp(file_of({0, 90, 180}, {0}, [](double, double) { return 250.0; }));
    CHECK(agree(flux(*even), 4 * k_pi * 250, 1e-4));
    const auto point = instance<Light>("point", {{"position", Vec3{0, 0, 0}}, {"intensity", 250 / k_pi}});
    for (const Vec3 position : {Vec3{1, 2, 3}, {-0.1f, 4, 0}, {0, -2, 0}}) {
        const IncidentSample a = illuminate(*even, {position})[0], b = illuminate(*point, {position})[0];
        CHECK(agree(a.diffuse, exact(b.diffuse), 1e-5));
        CHECK(agree(a.specular, exact(b.specular), 1e-5));
        CHECK(a.to_light == b.to_light);
    }
}

TEST_CASE("light/ies without a file is light/point") {
    const auto light = instance<Light>(
        "ies", {{"position", Vec3{1, 2, 3}}, {"direction", Vec3{0, -1, 0}}, {"intensity", 5.0}});
    const auto point = instance<Light>("point", {{"position", Vec3{1, 2, 3}}, {"intensity", 5.0}});
    for (const Vec3 position : {Vec3{}, {1, 0, 3}, {4, 4, 4}})
        CHECK(agree(illuminate(*light, {position})[0].diffuse,
                    exact(illuminate(*point, {position})[0].diffuse), 1e-5));
}

TEST_CASE("light/ies: a lobe of I cos v has pi I lumens, and is dark beyond the measured angles") {
    const auto lobe =
        lamp(file_of(steps(0, 90, 90), {0}, [](double v, double) { return 100 * std::cos(v * k_pi / 180); }));
    CHECK(agree(flux(*lobe), 100 * k_pi, 1e-4));
    for (const double v : {0.0, 17.0, 45.0, 60.0, 89.0})
        CHECK(agree(sent(*lobe, at(v, 33)), 100 * std::cos(v * k_pi / 180), 1e-3));
    CHECK(sent(*lobe, at(90.5, 0)) == 0);
    CHECK(sent(*lobe, at(180, 0)) == 0);
    // An uplight: nothing below the horizon.
    const auto up = lamp(file_of({90, 135, 180}, {0}, [](double, double) { return 100.0; }));
    CHECK(sent(*up, at(89.5, 0)) == 0);
    CHECK(agree(sent(*up, at(120, 0)), 100, 1e-5));
}

TEST_CASE("light/ies interpolates linearly between measured angles, whatever their steps") {
    const std::vector<double> vertical{0, 2.5, 7, 20, 21.25, 60}, horizontal{0, 10, 45, 52.5, 180};
    const auto candela = [](double v, double h) { return 9000 - 100 * v + 0.3 * v * h + 0.1 * v * v * h; };
    const auto light = lamp(file_of(vertical, horizontal, candela));
    for (std::size_t i = 0; i + 1 < vertical.size(); ++i) {
        for (std::size_t j = 0; j + 1 < horizontal.size(); ++j) {
            for (const double t : {0.0, 0.3, 0.75}) {
                const double v0 = vertical[i], v1 = vertical[i + 1], h0 = horizontal[j],
                             h1 = horizontal[j + 1];
                const auto row = [&](double h) { return (1 - t) * candela(v0, h) + t * candela(v1, h); };
                const double expected = (1 - t) * row(h0) + t * row(h1);
                INFO(v0 << " to " << v1 << ", " << h0 << " to " << h1 << " at " << t);
                CHECK(agree(sent(*light, at(v0 + t * (v1 - v0), h0 + t * (h1 - h0))), expected, 1e-4));
            }
        }
    }
}

TEST_CASE("light/ies fills in what symmetry leaves out, for each range of horizontal angles") {
    // Even in both planes, in one, in the other, and in none.
    const auto both = [](double v, double h) { return v + 100 + 50 * std::cos(2 * h * k_pi / 180); };
    const auto in_x = [](double v, double h) { return v + 100 + 50 * std::cos(h * k_pi / 180); };
    const auto in_z = [](double v, double h) { return v + 100 + 50 * std::sin(h * k_pi / 180); };
    const auto none = [](double v, double h) { return v + 100 + 50 * std::cos((h - 20) * k_pi / 180); };
    const auto check = [](const Candela& candela, const std::vector<double>& horizontal) {
        const auto light = lamp(file_of({0, 30, 60, 90}, horizontal, candela));
        for (const double h : steps(-170, 180, 35)) {
            INFO("from " << horizontal.front() << " to " << horizontal.back() << ", at " << h);
            CHECK(agree(sent(*light, at(60, h)), candela(60, h), 1e-4));
        }
    };
    check(both, steps(0, 90, 9));
    check(in_x, steps(0, 180, 18));
    check(in_z, steps(90, 270, 18));
    check(none, steps(0, 360, 36));
    check(none, steps(0, 350, 35));  // without the angle that closes the circle
}

TEST_CASE(
    "light/ies: the axis is where the vertical angle is 0, and rotation is counter-clockwise from above") {
    const std::string bright_at_0 = file_of({0, 90, 180}, steps(0, 360, 4), [](double v, double h) {
        return v == 90 ? (h == 0 || h == 360 ? 100.0 : h == 90 ? 50.0 : 10.0) : v == 0 ? 1000.0 : 1.0;
    });
    const auto down = lamp(bright_at_0);
    CHECK(agree(sent(*down, {0, -1, 0}), 1000, 1e-4));
    CHECK(agree(sent(*down, {0, 1, 0}), 1, 1e-3));
    CHECK(agree(sent(*down, {1, 0, 0}), 100, 1e-4));
    CHECK(agree(sent(*down, {0, 0, -1}), 50, 1e-4));
    CHECK(agree(sent(*down, {-1, 0, 0}), 10, 1e-4));
    const auto turned = lamp(bright_at_0, {0, -1, 0}, 90);
    CHECK(agree(sent(*turned, {0, 0, -1}), 100, 1e-4));
    CHECK(agree(sent(*turned, {-1, 0, 0}), 50, 1e-4));
    const auto forward = lamp(bright_at_0, {0, 0, -1});
    CHECK(agree(sent(*forward, {0, 0, -1}), 1000, 1e-4));
    CHECK(agree(sent(*forward, {1, 0, 0}), 100, 1e-4));
    CHECK(agree(sent(*forward, {0, 1, 0}), 50, 1e-4));
    const auto aside = lamp(bright_at_0, {2, 0, 0});
    CHECK(agree(sent(*aside, {1, 0, 0}), 1000, 1e-4));
    CHECK(agree(sent(*aside, {0, 1, 0}), 100, 1e-4));
}

TEST_CASE("light/ies applies the multiplier and the ballast factor; the factor after it only before 1995") {
    const auto even = [](const std::string& header) {
        return sent(*lamp(file_of(
                        {0, 180}, {0}, [](double, double) { return 100.0; }, header, "2", "0.9 0.5 50")),
                    {1, 0, 0});
    };
    for (const char* const header :
         {"IESNA:LM-63-1995\n", "IESNA:LM-63-2002\n[TEST] none\n", "IES:LM-63-2019\n"}) {
        INFO(header);
        CHECK(agree(even(header), 180, 1e-5));
    }
    for (const char* const header : {"", "a lamp of 1986\n", "IESNA91\n[TEST] none\n"}) {
        INFO(header);
        CHECK(agree(even(header), 90, 1e-5));
    }
    const auto light = instance<Light>(
        "ies", {{"file", written(file_of({0, 180}, {0}, [](double, double) { return 100.0; }))},
                {"position", Vec3{0, 0, 0}},
                {"direction", Vec3{0, -1, 0}},
                {"intensity", 0.25},
                {"color", Vec3{255, 127.5f, 0}}});
    const IncidentSample there = illuminate(*light, {{0, 2, 0}})[0];
    CHECK(agree(there.diffuse, Double3{25 / k_pi / 4, 12.5 / k_pi / 4, 0}, 1e-5));
}

TEST_CASE("light/ies reads files as programs write them: any line breaks, commas, exponents, tilt factors") {
    const std::string free_form =
        "\xef\xbb\xbfIESNA91\r\nTILT=INCLUDE\r\n1\r\n3\r\n0 45 90\r\n1 0.9 0.8\r\n 1, 1000, +1E+0, 3, "
        "1,\r\n1 2 0\r\n0 0 1 "
        "1 40\r\n0\r\n45 90 \r\n0\r\n1e2,50.5\r\n.25\r\n\x1a";
    const auto light = lamp(free_form);
    CHECK(agree(sent(*light, at(0, 0)), 100, 1e-5));
    CHECK(agree(sent(*light, at(45, 7)), 50.5, 1e-4));
    CHECK(agree(sent(*light, at(90, 7)), 0.25, 1e-3));
    CHECK(agree(sent(*lamp("TILT=LAMP.TLT\n1 1 1 1 1 1 1 0 0 0 1 1 1\n0\n0\n7\n"), {0, -1, 0}), 7, 1e-5));
}

TEST_CASE("light/ies names the line of what it cannot read, and what it expected there") {
    const std::string good = file_of({0, 45, 90}, {0, 180}, [](double, double) { return 5.0; });
    const auto with = [&](const std::string& part, const std::string& other) {
        std::string text = good;
        REQUIRE(holds(text, part));
        return refusal_of(text.replace(text.find(part), part.size(), other));
    };
    CHECK(refusal_of(good).empty());
    CHECK(holds(refusal_of(""), "lamp.ies:1: the file ends here; expected a line 'TILT=NONE'"));
    CHECK(holds(refusal_of("hello\nworld\n"), "lamp.ies:2: the file ends here; expected a line 'TILT=NONE'"));
    CHECK(holds(refusal_of(good.substr(0, good.size() - 2)),
                "lamp.ies:12: the file ends here; expected candela value 6 of 6"));
    CHECK(holds(with("1 -1 1", "1 -1 x1"), "lamp.ies:4: 'x1' is not a number; expected the multiplier"));
    CHECK(holds(with("1 -1 1", "1 -1 nan"), "'nan' is not a number"));
    CHECK(
        holds(with("1 -1 1", "1 -1 0"), "the multiplier of candela values is 0; expected a positive number"));
    CHECK(holds(with(" 3 2 1 2", " 3 2 2 2"), "lamp.ies:4: the photometry is of type B; expected type C"));
    CHECK(holds(with(" 3 2 1 2", " 3 2 3 2"), "the photometry is of type A; expected type C"));
    CHECK(holds(with(" 3 2 1 2", " 3 2 7 2"), "the photometric type is 7; expected 1, type C"));
    CHECK(holds(with(" 3 2 1 2", " 0 2 1 2"), "the number of vertical angles is 0; expected 1 to 3601"));
    CHECK(holds(with(" 3 2 1 2", " 2.5 2 1 2"), "the number of vertical angles is 2.5; expected 1 to 3601"));
    CHECK(holds(with(" 3 2 1 2", " 3 1e9 1 2"),
                "the number of horizontal angles is 1e+09; expected 1 to 3601"));
    CHECK(holds(with(" 3 2 1 2", " 3600 3600 1 2"),
                "3600 x 3600 angles are too many; expected at most 500000"));
    CHECK(
        holds(with("0 45 90", "0 45 190"), "lamp.ies:6: a vertical angle is 190; expected 0 to 180 degrees"));
    CHECK(holds(with("0 45 90", "0 45 45"), "a vertical angle is 45, after 45; expected ascending ones"));
    CHECK(holds(with("0 180", "0 120"),
                "lamp.ies:7: the horizontal angles are 0 to 120; expected 0 alone, or 0 to 90, 180 or 360"));
    CHECK(holds(with("5\n", "-5\n"), "lamp.ies:8: candela value 1 is -5, times 1; expected 0 to 1e+12"));
    CHECK(holds(with("5\n", "1e30\n"), "candela value 1 is 1e+30, times 1; expected 0 to 1e+12"));
    CHECK(holds(with("5\n", std::string(1000, '\x01') + "\n"),
                "'" + std::string(40, '?') + "...' is not a number"));
}

TEST_CASE("light/ies refuses a file that is too large, a folder, and one that is not there") {
    const std::string path = written("");
    std::filesystem::resize_file(path, std::uintmax_t{1} << 34);
    const auto refusal = [](const std::string& name) {
        try {
            instance<Light>("ies", {{"file", name}, {"position", Vec3{}}, {"direction", Vec3{0, -1, 0}}});
        } catch (const candela::Error& problem) {
            return std::string(problem.what());
        }
        return std::string();
    };
    CHECK(holds(refusal(path), "has 17179869184 bytes; expected at most 16777216"));
    std::filesystem::remove(path);
    CHECK(holds(refusal(path), "lamp.ies' is not a file"));
    CHECK(holds(refusal(scratch_directory().string()), "is not a file"));
}
