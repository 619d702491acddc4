#include <catch2/catch_test_macros.hpp>
#include <string>

#include "json/json.h"

TEST_CASE("JSON is safe for any reader and any terminal, whatever bytes a string has") {
    CHECK(json_text({{"name", "a\xffz"}}) == "{\"name\":\"a\xef\xbf\xbdz\"}");  // U+FFFD
    const std::string text = json_text({{"title", "\xe2\x80\xae\x1b[2J caf\xc3\xa9"}});
    CHECK(text == "{\"title\":\"\\u202e\\u001b[2J caf\xc3\xa9\"}");
    CHECK(parse_json(text).at("title") == "\xe2\x80\xae\x1b[2J caf\xc3\xa9");
}

TEST_CASE("members of JSON stay in the order in which they were added or read") {
    const Json json = {{"b", 1}, {"a", Json::array({2})}};
    CHECK(json_text(json, 1) == "{\n \"b\": 1,\n \"a\": [\n  2\n ]\n}");
    CHECK(json_text(parse_json(json_text(json))) == json_text(json));
}

TEST_CASE("invalid JSON is refused, or discarded on request") {
    for (const char* const text : {"", "{", "{\"a\":}", "[1] 2", "\"\xff\""}) {
        INFO(text);
        CHECK_THROWS_AS(parse_json(text), Json::parse_error);
        CHECK(json_or_discarded(text).is_discarded());
    }
}
