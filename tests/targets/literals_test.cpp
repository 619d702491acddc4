// Texts in generated programs and pages.
#include "candela/target/literals.h"
#include "candela/target/base64.h"

#include <catch2/catch_test_macros.hpp>
#include <cstddef>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "candela/target/text_template.h"

using candela::target::append_base64;
using candela::target::ascii_identifier;
using candela::target::base64;
using candela::target::base64_decoded;
using candela::target::filled;
using candela::target::html_text;

namespace {

std::span<const std::byte> bytes_of(std::string_view text) { return std::as_bytes(std::span(text)); }

}  // namespace

TEST_CASE("base64: the test vectors of RFC 4648, section 10") {
    const std::string_view text = "foobar";
    const std::string_view expected[] = {"", "Zg==", "Zm8=", "Zm9v", "Zm9vYg==", "Zm9vYmE=", "Zm9vYmFy"};
    for (std::size_t size = 0; size <= text.size(); ++size) {
        CHECK(base64(bytes_of(text.substr(0, size))) == expected[size]);
        CHECK(base64_decoded(expected[size]) == text.substr(0, size));
    }
}

TEST_CASE("base64: every byte survives a round trip, whatever precedes it") {
    std::string bytes;
    for (int i = 0; i < 256; ++i) bytes += static_cast<char>(i);
    for (std::size_t shift = 0; shift < 3; ++shift, bytes.insert(bytes.begin(), '\xff'))
        CHECK(base64_decoded(base64(bytes_of(bytes))) == bytes);
    std::string text = "data:";
    append_base64(bytes_of("Ma"), text);
    CHECK(text == "data:TWE=");
}

TEST_CASE("a template's placeholders are filled in one pass, and an unfilled one is an error") {
    CHECK(filled("a @X@ b\n@Y@\nc", {{"X", "@Y@"}, {"Y", ""}}) == "a @Y@ b\nc");
    CHECK(filled("me@example.org @X", {}) == "me@example.org @X");
    CHECK_THROWS_AS(filled("@X@", {{"Y", "1"}}), std::logic_error);
}

TEST_CASE("names in comments are safe: ASCII, one line, without quotes, and short, whatever their bytes") {
    CHECK(ascii_identifier("'Größe'") == "Groesse");
    CHECK(ascii_identifier("Ёлка, Φῶς") == "____, ___");
    CHECK(ascii_identifier("a\nb*/\\") == "a_b___");
    CHECK(ascii_identifier("\xc3") == "_");
    CHECK(ascii_identifier("a\xff\xe2\x82z") == "a__z");
    CHECK(ascii_identifier(std::string(1000, 'x')).size() == 100);
}

TEST_CASE("a page's text is UTF-8 without markup, whatever bytes it is made from") {
    CHECK(html_text("<a href=\"x\">'&'") == "&lt;a href=&quot;x&quot;&gt;&#39;&amp;&#39;");
    CHECK(html_text("Größe \xe2\x82\xac \xf0\x9f\x92\xa1") == "Größe \xe2\x82\xac \xf0\x9f\x92\xa1");
    CHECK(html_text("\xff<\xe2\x82") == "\xef\xbf\xbd&lt;\xef\xbf\xbd");
}
