#include <catch2/catch_test_macros.hpp>
#include <string>
#include <string_view>

#include "support/command.h"

import candela.plugins;

using namespace std::string_view_literals;

TEST_CASE("a picture's first bytes identify its format, and those of other files identify none") {
    struct Case {
        std::string_view head, format;
    };
    for (const Case& file :
         {Case{"\x89PNG\r\n\x1a\n\0\0\0\rIHDR"sv, "png"}, Case{"\xff\xd8\xff\xe0\0\x10JFIF"sv, "jpg"},
          Case{"II*\0\x08\0\0\0"sv, "tif"}, Case{"MM\0*\0\0\0\x08"sv, "tif"},
          Case{"\x76\x2f\x31\x01\2\0\0\0"sv, "exr"}, Case{"#?RADIANCE\n"sv, "hdr"},
          Case{"RIFF\x24\0\0\0WEBPVP8 "sv, "webp"}, Case{"BM\x46\0\0\0\0\0\0\0\x36\0\0\0"sv, "bmp"},
          Case{"P6\n1 1\n255\n"sv, "ppm"}, Case{"P5 1 1 255 "sv, "pnm"}, Case{"PF\n1 1\n-1.0\n"sv, "pfm"},
          Case{"GIF89a"sv, "gif"}, Case{""sv, ""}, Case{"P6"sv, ""}, Case{"BMW is a car maker"sv, ""},
          Case{"RIFF\x24\0\0\0WAVE"sv, ""}, Case{"hello"sv, ""}, Case{"\0\0\2\0"sv, ""}}) {
        INFO(std::string(file.head));
        CHECK(candela::format_by_content(file.head) == file.format);
    }
}

TEST_CASE("a file's format depends on its content; anything but a regular file has none") {
    const auto folder = scratch_directory();
    CHECK(candela::format_of_content(write_file(folder / "a.png", "\xff\xd8\xff\xe0")) == "jpg");
    CHECK(candela::format_of_content(write_file(folder / "b.png", "")).empty());
    CHECK(candela::format_of_content(folder).empty());
    CHECK(candela::format_of_content(folder / "none").empty());
}

TEST_CASE("extensions of one format are recognised as such") {
    CHECK(candela::are_one_format("jpg", "jpeg"));
    CHECK(candela::are_one_format("tiff", "tif"));
    CHECK(candela::are_one_format("png", "png"));
    CHECK_FALSE(candela::are_one_format("jpg", "png"));
    CHECK_FALSE(candela::are_one_format("jpg", "tif"));
}
