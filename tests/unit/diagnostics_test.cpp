#include <catch2/catch_test_macros.hpp>
#include <nlohmann/json.hpp>
#include <string>

#include "console/diagnostics_text.h"

#include "support/text.h"

import candela.core;

using candela::Diagnostics;
using candela::ErrorCategory;

TEST_CASE("a diagnostic shows its line with a mark below the position") {
    candela::Diagnostics diagnostics;
    diagnostics.remember_source("a.toml", "one\n\tkey = 3\n");
    diagnostics.error({"a.toml", 2, 2, 3}, "wrong", "try this");
    CHECK(diagnostics_text(diagnostics, false) ==
          "a.toml:2:2: error: wrong\n    2 | \tkey = 3\n      | \t^^^ try this\n");
    CHECK(holds(diagnostics_text(diagnostics, true), "\x1b[1m\x1b[31merror:"));
    candela::Diagnostics whole;
    whole.warning({"b.toml", 0, 0, 0}, "odd");
    CHECK(diagnostics_text(whole, false) == "b.toml: warning: odd\n");
}

TEST_CASE("the mark stands under its character, whatever precedes it, and terminal commands are escaped") {
    Diagnostics diagnostics;
    diagnostics.remember_source("a.toml", "\xc3\xa9\x1b[31m = 3\n");
    diagnostics.error({"a.toml", 1, 9, 1}, "wrong");
    CHECK(diagnostics_text(diagnostics, false) ==
          "a.toml:1:9: error: wrong\n    1 | \xc3\xa9\\u{1b}[31m = 3\n      |              ^\n");
}

TEST_CASE("of a very long line, only the part around the position is shown") {
    Diagnostics diagnostics;
    diagnostics.remember_source("a.toml", std::string(1000, 'x') + "HERE" + std::string(1000, 'y'));
    diagnostics.error({"a.toml", 1, 1001, 4}, "wrong");
    const std::string text = diagnostics_text(diagnostics, false);
    CHECK(text.size() < 500);
    const std::size_t line = text.find("    1 | ");
    const std::size_t marks = text.find("      | ", line);
    CHECK(text.find("HERE") - line == text.find("^^^^") - marks);
}

TEST_CASE("at most 50 diagnostics are shown, in order of position, and the rest are counted") {
    Diagnostics diagnostics;
    diagnostics.remember_source("a.toml", std::string(80, '\n'));
    for (int line = 80; line > 0; --line) {
        const candela::SourceLocation place{"a.toml", line, 1, 1};
        line % 4 == 0 ? diagnostics.warning(place, "odd") : diagnostics.error(place, "wrong");
    }
    const std::string text = diagnostics_text(diagnostics, false);
    CHECK(text.starts_with("a.toml:1:1: error: wrong\n"));
    CHECK(holds(text, "a.toml:50:1:"));
    CHECK_FALSE(holds(text, "a.toml:51:1:"));
    CHECK(text.ends_with("and 30 more (22 of them errors)\n"));
}

TEST_CASE("an invalid scene takes precedence over a failure; warnings do not count") {
    Diagnostics diagnostics;
    diagnostics.warning({"a.toml", 1, 1, 1}, "odd");
    CHECK_FALSE(diagnostics.has_errors());
    diagnostics.failure({"a.toml", 1, 1, 1}, "gone");
    CHECK(diagnostics.worst() == ErrorCategory::failure);
    diagnostics.error({"a.toml", 1, 1, 1}, "wrong");
    diagnostics.failure({"a.toml", 1, 1, 1}, "gone");
    CHECK(diagnostics.worst() == ErrorCategory::invalid_scene);
}

TEST_CASE("diagnostics as JSON are complete, and valid JSON whatever bytes a file contains") {
    Diagnostics diagnostics;
    diagnostics.error({"a\"\xff.toml", 3, 7, 2}, "'kd\n' is wrong", "try 0.5");
    const auto all = nlohmann::json::parse(diagnostics_json(diagnostics));
    REQUIRE(all.size() == 1);
    CHECK(all[0]["severity"] == "error");
    CHECK(all[0]["line"] == 3);
    CHECK(all[0]["column"] == 7);
    CHECK(all[0]["length"] == 2);
    CHECK(all[0]["message"] == "'kd\n' is wrong");
    CHECK(all[0]["hint"] == "try 0.5");
}
