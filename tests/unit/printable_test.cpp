// Escaping of text that a terminal, a reader or a JSON parser would take for something else.
#include <array>
#include <catch2/catch_test_macros.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "json/json.h"
#include "support/text.h"

import candela.core;

using candela::LineBreaks;
using candela::printable;

TEST_CASE("text of visible characters is unchanged") {
    for (const std::string_view text :
         {"", "plain", "caf\xc3\xa9 \xe2\x82\xac \xe6\xbc\xa2 \xf0\x9f\x92\xa1", "a\tb"})
        CHECK(printable(text) == text);
}

TEST_CASE("terminal controls are shown as their code points: C0, DEL, C1") {
    CHECK(printable("\x1b]0;title\x07") == "\\u{1b}]0;title\\u{7}");
    CHECK(printable(std::string_view("a\0b", 3)) == "a\\u{0}b");
    CHECK(printable("\x7f\xc2\x9b\xc2\x85") == "\\u{7f}\\u{9b}\\u{85}");
    CHECK(printable("a\r\nb") == "a\\u{d}\\u{a}b");
    CHECK(printable("a\r\nb", LineBreaks::kept) == "a\\u{d}\nb");
}

TEST_CASE("characters that turn the direction of writing, or are invisible, are shown as their code points") {
    // RLO, PDI, zero-width space, soft hyphen, byte-order mark, variation selector, tag.
    CHECK(printable("\xe2\x80\xae\xe2\x81\xa9\xe2\x80\x8b\xc2\xad\xef\xbb\xbf") ==
          "\\u{202e}\\u{2069}\\u{200b}\\u{ad}\\u{feff}");
    CHECK(printable("\xef\xb8\x8f\xf3\xa0\x80\x81\xe2\x80\xa8") == "\\u{fe0f}\\u{e0001}\\u{2028}");
    // Their neighbours are visible.
    for (const std::string_view text : {"\xe2\x80\x90", "\xe2\x80\xaf", "\xc2\xa0", "\xc2\xac", "\xc2\xae"})
        CHECK(printable(text) == text);
}

TEST_CASE("bytes that are not UTF-8 are shown as bytes") {
    CHECK(printable("a\xff\xc3z") == "a\\x{ff}\\x{c3}z");
    CHECK(printable("\xed\xa0\x80") == "\\x{ed}\\x{a0}\\x{80}");  // half of a surrogate pair
    CHECK(printable("\xc0\xaf") == "\\x{c0}\\x{af}");             // a slash in two bytes
}

TEST_CASE("printable text is valid UTF-8, and unchanged when made printable again, whatever it came from") {
    std::string all;
    for (int i = 0; i < 256; ++i) {
        for (const char* const between : {"", "\xe2\x80", "\xc2"})
            all += between + std::string(1, static_cast<char>(i));
    }
    const std::string once = printable(all);
    CHECK_FALSE(candela::first_invalid_byte(once));
    CHECK(printable(once) == once);
}

TEST_CASE("printable JSON means the same") {
    const std::string hidden = "\x7f\xc2\x9b\xe2\x80\xae\xf3\xa0\x80\x81 \xc3\xa9";
    const nlohmann::json value = {{"name", hidden}, {"list", {1, "a\n\x1b"}}};
    const std::string text = printable_json(value.dump(2));
    CHECK(printable(text, LineBreaks::kept) == text);
    CHECK(holds(text, "\xc3\xa9"));
    CHECK(nlohmann::json::parse(text) == value);
}

TEST_CASE("a TOML string with hidden characters is printable, and reads back unchanged") {
    const std::string text = "\xe2\x80\xae\x01\xf3\xa0\x80\x81\xc2\x9b \xc3\xa9 \"\\";
    const std::string toml = candela::toml_text(text);
    CHECK(printable(toml) == toml);
    candela::Diagnostics diagnostics;
    const auto node = candela::parse_value(toml, {}, diagnostics);
    REQUIRE(node);
    CHECK(std::get<std::string>(node->value) == text);
}
