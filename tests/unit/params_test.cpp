#include <candela/plugin/abi.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <new>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "support/samples.h"
#include "support/text.h"

using candela::Parameter;
using candela::ParamSet;
using candela::ParamType;
using candela::Value;
using candela::Vec3;

namespace {

ParamSet set_of(Parameter parameter) { return ParamSet({std::move(parameter)}); }

candela::Manifest sample_manifest() {
    candela::Manifest m;
    m.abi = candela::host_abi();
    m.kind = candela::PluginKind::light;
    m.name = "lamp";
    m.version = "1.2.3";
    m.title = "Lamp \"quoted\"";
    m.formula = "a\nb";
    m.parameters = {
        {.name = "size",
         .type = ParamType::real,
         .unit = "m",
         .meaning = "x",
         .default_value = 0.1,
         .minimum = 0,
         .minimum_excluded = true},
        {.name = "count",
         .type = ParamType::integer,
         .meaning = "x",
         .default_value = std::int64_t{3},
         .minimum = 1,
         .maximum = 9},
        {.name = "on", .type = ParamType::boolean, .meaning = "x", .default_value = true},
        {.name = "law",
         .type = ParamType::choice,
         .meaning = "x",
         .default_value = std::string("b"),
         .choices = {"a", "b"}},
        {.name = "at", .type = ParamType::point, .meaning = "x", .default_value = std::nullopt},
        {.name = "tint", .type = ParamType::color, .meaning = "x", .default_value = Vec3{1, 2, 3}},
        {.name = "kd",
         .type = ParamType::rgb,
         .meaning = "x",
         .default_value = Vec3{0.1f, 0.2f, 0.3f},
         .maximum = 1,
         .maximum_excluded = true},
        {.name = "turn",
         .type = ParamType::matrix,
         .meaning = "x",
         .default_value = candela::Matrix{1, 0, 0.1f, 0, 1, 0, 0, 0, -1}},
        {.name = "ramp",
         .type = ParamType::numbers,
         .meaning = "x",
         .default_value = std::vector<float>{0.1f, 2}}};
    m.relations = {{candela::RelationType::less, "size", "count", true, "why"}};
    m.properties = {{"closed", "true"}, {"euler", "2"}};
    m.presets = {
        {.name = "large", .source = "nobody", .values = {{"size", 0.5}}, .color = {}},
        {.name = "red", .source = "", .values = {{"size", 0.25}}, .color = candela::Vec3{255, 0, 0}}};
    m.formats = {{"foo", "Foo", candela::PixelType::real}};
    m.has_kernel = true;
    m.kernel_prefix = "lamp";
    m.kernel_parameters = "LampLight";
    m.author = "Bùi Tường Phong";
    m.license = "MIT";
    return m;
}

}  // namespace

TEST_CASE("a manifest written as JSON and read again is the same manifest") {
    const candela::Manifest manifest = sample_manifest();
    CHECK((candela::manifest_from_json(candela::to_json(manifest)) == manifest));
}

TEST_CASE("an invalid manifest is refused with a reason") {
    for (const char* const text : {"", "{", "[]", "3", "{}", R"({"candela_manifest": 7})",
                                   R"({"candela_manifest": 1, "abi": "x", "kind": "toaster"})",
                                   R"({"candela_manifest": 1, "abi": 4})"}) {
        INFO(text);
        CHECK_THROWS_AS(candela::manifest_from_json(text), candela::Error);
    }
}

TEST_CASE("a plugin's author and licence are short, and consist of visible characters") {
    candela::Manifest manifest = sample_manifest();
    const auto is_refused = [&] {
        return message_of<candela::Error>([&] { candela::manifest_from_json(candela::to_json(manifest)); });
    };
    manifest.author = std::string(200, 'a');
    CHECK(is_refused().empty());
    manifest.author += 'a';
    CHECK(is_refused() == "its author has 201 characters; at most 200 are allowed");
    manifest.author = "an\x1b[31mybody";
    CHECK(is_refused() == "its author 'an\\u{1b}[31mybody' contains invisible characters");
    manifest.author.clear();
    manifest.license = "MIT\n";
    CHECK(is_refused() == "its license 'MIT\\u{a}' contains invisible characters");
    manifest.license.clear();
    CHECK(candela::to_json(manifest).find("license") == std::string::npos);
    CHECK(is_refused().empty());
}

TEST_CASE("parameters are delivered as plugins expect them") {
    using candela::ColorEncoding;
    ParamSet angle =
        set_of({.name = "a", .type = ParamType::real, .unit = "deg", .meaning = "", .default_value = 180.0});
    CHECK(agree(angle.runtime(ColorEncoding::none)[0].number[0], 3.14159265, 1e-6));
    ParamSet direction =
        set_of({.name = "d", .type = ParamType::direction, .meaning = "", .default_value = Vec3{0, 3, 4}});
    CHECK(direction.runtime(ColorEncoding::none)[0].number[1] == 0.6f);
    ParamSet color =
        set_of({.name = "c", .type = ParamType::color, .meaning = "", .default_value = Vec3{255, 51, 0}});
    CHECK(agree(color.runtime(ColorEncoding::none)[0].number[1], 0.2, 1e-6));
    CHECK(agree(color.runtime(ColorEncoding::srgb)[0].number[1], 0.033105, 1e-4));
    ParamSet choice = set_of({.name = "w",
                              .type = ParamType::choice,
                              .meaning = "",
                              .default_value = std::string("two"),
                              .choices = {"one", "two"}});
    CHECK(choice.runtime(ColorEncoding::none)[0].integer == 1);
    ParamSet required =
        set_of({.name = "r", .type = ParamType::point, .meaning = "", .default_value = std::nullopt});
    CHECK_THROWS_AS(required.runtime(ColorEncoding::none), std::invalid_argument);
}

TEST_CASE("matrices are delivered row by row, lists complete, and both are written as in a scene file") {
    const candela::Matrix rows{1, 2, 3, 4, 5, 6, 7, 8, 9};
    ParamSet set(
        {{.name = "m", .type = ParamType::matrix, .default_value = rows},
         {.name = "n", .type = ParamType::numbers, .default_value = std::vector<float>{0.5f, 2, 1}}});
    const auto delivered = set.runtime(candela::ColorEncoding::none);
    CHECK(std::ranges::equal(delivered[0].number, rows));
    CHECK(std::ranges::equal(delivered[1].list, std::vector<float>{0.5f, 2, 1}));
    CHECK(candela::text_of(set.get("m")) == "[[1, 2, 3], [4, 5, 6], [7, 8, 9]]");
    CHECK(candela::text_of(set.get("n")) == "[0.5, 2, 1]");
    set.set("n", std::vector<float>{7});
    CHECK(set.runtime(candela::ColorEncoding::none)[1].list.size() == 1);
    CHECK_THROWS_AS(set.set("n", std::vector<float>{}), std::invalid_argument);
    CHECK_THROWS_AS(set.set("n", std::vector<float>{1, std::numeric_limits<float>::infinity()}),
                    std::invalid_argument);
    CHECK_THROWS_AS(set.set("m", std::vector<float>(9)), std::invalid_argument);
}

TEST_CASE("the range of a matrix or a list is that of each of its numbers") {
    ParamSet set = set_of({.name = "n",
                           .type = ParamType::numbers,
                           .meaning = "",
                           .default_value = std::vector<float>{0},
                           .minimum = 0,
                           .maximum = 1});
    set.set("n", std::vector<float>{0, 1, 0.5f});
    CHECK_THROWS_AS(set.set("n", std::vector<float>{0, 1.5f, 0.5f}), std::invalid_argument);
    CHECK(candela::constraint_text(set.schema()[0]) == "a list of at least one number, each 0 to 1");
}

TEST_CASE("a parameter set accepts valid values and nothing else") {
    ParamSet set = set_of({.name = "kd",
                           .type = ParamType::rgb,
                           .meaning = "",
                           .default_value = Vec3{},
                           .minimum = 0,
                           .maximum = 1});
    set.set("kd", 0.5);
    CHECK(std::get<Vec3>(set.get("kd")) == Vec3{0.5f, 0.5f, 0.5f});
    set.set("kd", std::int64_t{1});
    CHECK(std::get<Vec3>(set.get("kd")) == Vec3{1, 1, 1});
    CHECK_THROWS_AS(set.set("kd", 1.5), std::invalid_argument);
    CHECK_THROWS_AS(set.set("kd", std::string("red")), std::invalid_argument);
    CHECK_THROWS_AS(set.set("ks", 0.5), std::invalid_argument);
    CHECK_THROWS_AS(set.get("ks"), std::invalid_argument);
}

TEST_CASE("the sRGB transfer functions are those of IEC 61966-2-1, and inverse to each other") {
    CHECK(candela::srgb_to_linear(0) == 0);
    CHECK(agree(candela::srgb_to_linear(1), 1, 1e-6));
    CHECK(agree(candela::srgb_to_linear(0.5f), 0.21404, 1e-4));
    CHECK(agree(candela::linear_to_srgb(0.18f), 0.46136, 1e-4));
    for (int i = 0; i < 256; ++i) {
        const auto encoded = static_cast<float>(i) / 255;
        CHECK(std::lround(255 * candela::linear_to_srgb(candela::srgb_to_linear(encoded))) == i);
    }
}

TEST_CASE("every 8-bit colour survives decoding and the film's encoding") {
    for (const candela::ColorEncoding encoding :
         {candela::ColorEncoding::srgb, candela::ColorEncoding::none}) {
        candela::Film film(256, 1, candela::PixelType::byte, encoding);
        candela::Vec3Arrays row;
        row.resize(256);
        for (int i = 0; i < 256; ++i) {
            const auto x = static_cast<float>(i);
            const candela::Rgb rgb = candela::decoded({x, x, x}, encoding);
            row.span().set(static_cast<std::size_t>(i), {rgb.r, rgb.g, rgb.b});
        }
        film.store(0, 0, 256, 1, row.span(), 256);
        for (std::size_t i = 0; i < 256; ++i) CHECK(film.view().bytes[3 * i + 1] == i);
    }
}

TEST_CASE("the film clamps values that are too bright, too dark or NaN") {
    candela::Film film(5, 1, candela::PixelType::byte, candela::ColorEncoding::srgb);
    candela::Vec3Arrays row;
    row.resize(5);
    const float values[] = {-1, 2, std::nanf(""), INFINITY, -INFINITY};
    for (std::size_t i = 0; i < 5; ++i) row.span().set(i, {values[i], values[i], values[i]});
    film.store(0, 0, 5, 1, row.span(), 5);
    const std::uint8_t expected[] = {0, 255, 0, 255, 0};
    for (std::size_t i = 0; i < 5; ++i) CHECK(film.view().bytes[3 * i] == expected[i]);
}

TEST_CASE("suggestions are close, and absent if nothing is") {
    const std::vector<std::string> words = {"shininess", "kd", "ks", "position"};
    CHECK(candela::closest("shinyness", words) == "shininess");
    CHECK(candela::closest("KD", words) == "kd");
    CHECK(candela::closest("postion", words) == "position");
    CHECK(candela::closest("opsition", words) == "position");
    CHECK_FALSE(candela::closest("wavelength", words));
    CHECK_FALSE(candela::closest("x", std::vector<std::string>{}));
}

TEST_CASE("a value that cannot be copied for lack of memory is unchanged, and the process survives") {
#if defined(__SANITIZE_ADDRESS__) || __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
    SKIP("sanitizers need address space");
#else
    const std::vector<std::optional<candela::Value>> values{std::string(std::size_t{256} << 20, 'x')};
    const pid_t child = ::fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        // Room for little more than what exists.
        std::ifstream pages("/proc/self/statm");
        rlim_t used = 0;
        pages >> used;
        const rlim_t limit = used * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE)) + (rlim_t{16} << 20);
        const rlimit room{.rlim_cur = limit, .rlim_max = limit};
        if (::setrlimit(RLIMIT_AS, &room) != 0) std::_Exit(2);
        try {
            const std::vector<std::optional<candela::Value>> copies = values;
            std::_Exit(copies.empty() ? 3 : 4);
        } catch (const std::bad_alloc&) {
            std::_Exit(0);
        }
    }
    int status = -1;
    REQUIRE(::waitpid(child, &status, 0) == child);
    REQUIRE(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 0);
#endif
}
