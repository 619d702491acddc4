// Invalid TOML or text: the place, and words for users who have not read the specification.
#include <catch2/catch_test_macros.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "support/command.h"
#include "support/expect.h"
#include "support/folder.h"
#include "support/text.h"

namespace {

struct Case {
    std::string text;
    std::string place;
    std::string message;
};

void check_all(const std::vector<Case>& cases, const std::string& before = "") {
    const Folder directory;
    for (const Case& c : cases) {
        directory.write("a.toml", before + c.text);
        const CommandResult result = directory.run("check a.toml");
        INFO(c.text << "\n" << result.err);
        CHECK(result.exit_code == 3);
        CHECK(holds(result.err, "a.toml:" + c.place + ": error: " + c.message));
    }
}

}  // namespace

TEST_CASE("mistakes in values are explained at their place") {
    check_all({
        {"a = \"srgb\nb = 3\n", "1:10", "this string has no closing quote on its line"},
        {"a = 'srgb\nb = 3\n", "1:10", "this string has no closing quote on its line"},
        {"a = \"srgb", "1:10", "the file ends within a string: its closing quote is missing"},
        {"a = \"\"\"srgb\n", "1:12", "the file ends within a string: its closing quote is missing"},
        {"a = \"C:\\scenes\"\n", "1:9", "\\s is not a valid escape"},
        {"a = \"x\x01y\"\n", "1:7", "a control character, which strings must not contain"},
        {"a = 12abc\n", "1:7", "'12abc' is not a number"},
        {"a = 1.\n", "1:7", "'1.' is not a number"},
        {"a = .5\n", "1:5", "'.5' is not a number"},
        {"a = 007\n", "1:8", "'007' is not a number, because it begins with 0"},
        {"a = 50%\n", "1:7", "'50%' is not a number"},
        {"a = 30\xc2\xb0\n", "1:7", "'30\xc2\xb0' is not a number"},
        {"a = 99999999999999999999\n", "1:25", "'99999999999999999999' is too large for an integer"},
        {"a = 1,5\n", "1:6", "expected the end of the line after the value, found ','"},
        {"a = 3 m\n", "1:7", "expected the end of the line after the value, found 'm'"},
        {"a = 1 b = 2\n", "1:7", "expected the end of the line after the value, found 'b'"},
        {"a = phong\n", "1:5", "'phong' is not a value"},
        {"a = \xe2\x80\x9cphong\xe2\x80\x9d\n", "1:5", "'\xe2\x80\x9cphong\xe2\x80\x9d' is not a value"},
        {"a = True\n", "1:5", "'True' is not a value"},
        {"a = NaN\n", "1:5", "'NaN' is not a value"},
        {"a = [1, 2\n", "1:10", "the file ends within a list: its closing ] is missing"},
        {"a = [1 2]\n", "1:8", "expected ',' or ']' in this list, found '2'"},
        {"a = [1,\nb = 3\n", "2:1", "'b' is not a value"},
        {"a = {b = 1,}\n", "1:12", "a comma before the closing } is not allowed"},
        {"a = {b = 1\n", "1:11", "expected a key, ',' or '}' in this table, found the end of the line"},
        {"a = 1979-13-41\n", "1:12", "this is not a date: expected month between 1 and 12"},
    });
}

TEST_CASE("mistakes in keys and headers are explained at their place") {
    check_all({
        {"width 3\n", "1:7", "expected '=' after the key, found '3'"},
        {"width : 3\n", "1:7", "expected '=' after the key, found ':'"},
        {"look at = 3\n", "1:6", "expected '=' after the key, found 'a'"},
        {"gr\xc3\xb6\xc3\x9f"
         "e = 3\n",
         "1:3", "expected '=' after the key, found '\xc3\xb6'"},
        {"width =\n", "1:8", "there is no value after '='"},
        {"a = 3\na = 4\n", "2:5", "'a' is given twice in one table"},
        {"[image\n", "1:7", "the header's closing ] is missing"},
        {"[[light]\n", "1:9", "the header's closing ] is missing"},
        {"[]\n", "1:2", "a header without a name"},
        {"[image] width = 3\n", "1:9", "expected the end of the line after the header, found 'w'"},
        {"[image]\n[image]\n", "2:1", "'image' is already there"},
        {"[[light]]\n[light]\n", "2:1", "'light' was a list before; here it is a table"},
        {"[light]\n[[light]]\n", "2:1", "'light' was a table or a value before; here it is a list"},
        {"{\"version\": 1}\n", "1:1", "expected a key or a [table], found '{'"},
        {"// a scene\n", "1:1", "expected a key or a [table], found '/'"},
        {"version: 1\n", "1:8", "expected '=' after the key, found ':'"},
        {"version = 1\r[image]\r", "1:13", "a line ends with a carriage return alone"},
    });
}

TEST_CASE("the error about invalid UTF-8 is at the first invalid character") {
    const std::string good =
        "# \xc2\xa2\xe2\x82\xac\xf0\x9f\x98\x80\xed\x9f\xbf\xee\x80\x80\xf4\x8f\xbf\xbf\n# \xc3\xa9";
    for (const std::string& bad :
         {std::string("\xe9"), std::string("\x80"), std::string("\xc0\x80"), std::string("\xc1\xbf"),
          std::string("\xe0\x9f\xbf"), std::string("\xed\xa0\x80"), std::string("\xf0\x8f\xbf\xbf"),
          std::string("\xf4\x90\x80\x80"), std::string("\xf5\x80\x80\x80"), std::string("\xff"),
          std::string("\xe2\x82"), std::string("\xe2\x82x"), std::string("\xf0\x9f\x98")}) {
        check_all({{good + bad, "2:4", "this is not UTF-8 text"},
                   {good + bad + "\na = 1\n", "2:4", "this is not UTF-8"}});
    }
}

TEST_CASE("UTF-16 is named; a UTF-8 byte order mark is accepted and takes no column") {
    const Folder directory;
    const auto checked = [&](const std::string& text) {
        const std::string file = directory.write("a.toml", text).string();
        return run_candela({"check", file}).err;
    };
    CHECK(holds(checked(std::string("\xff\xfe"
                                    "a\0=\0001\0",
                                    8)),
                "the file's text is UTF-16; a scene is UTF-8"));
    CHECK(holds(checked("\xef\xbb\xbf"
                        "a = b\n"),
                "a.toml:1:5: error: 'b' is not a value"));
}

TEST_CASE("letters of all alphabets are allowed in texts and comments, even after a continued line") {
    const Folder directory;
    const std::string file =
        directory
            .write(
                "a.toml",
                "version = 1 # \xd1\x81\xd1\x86\xd0\xb5\xd0\xbd\xd0\xb0\n[observer]\nposition = [0, 0, 4]\n"
                "look_at = [0, 0, 0]\n[[light]]\ntype = \"ambient\"\nname = \"\"\"\\\n   \xc3\xa9t\xc3\xa9 "
                "\\\n\n  "
                "\xe5\x85\x89\"\"\"\n")
            .string();
    expect(run_candela({"check", file}), 0);
}
