#include <png.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <initializer_list>
#include <memory>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "support/command.h"
#include "support/decoded.h"
#include "support/text.h"

namespace fs = std::filesystem;

namespace {

constexpr int k_width = 37, k_height = 23;  // so that Adam7's passes have remainders

struct Kind {
    int color_type;
    int depth;
    bool is_interlaced;

    std::size_t channels() const {
        switch (color_type) {
            case PNG_COLOR_TYPE_GRAY_ALPHA:
                return 2;
            case PNG_COLOR_TYPE_RGB:
                return 3;
            case PNG_COLOR_TYPE_RGB_ALPHA:
                return 4;
            default:
                return 1;
        }
    }
};

std::vector<Kind> all_kinds() {
    std::vector<Kind> kinds;
    const auto add = [&](int color_type, std::initializer_list<int> depths) {
        for (const int depth : depths) {
            for (const bool is_interlaced : {false, true})
                kinds.push_back({color_type, depth, is_interlaced});
        }
    };
    add(PNG_COLOR_TYPE_GRAY, {1, 2, 4, 8, 16});
    add(PNG_COLOR_TYPE_PALETTE, {1, 2, 4, 8});
    for (const int type : {PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB, PNG_COLOR_TYPE_RGB_ALPHA})
        add(type, {8, 16});
    return kinds;
}

/// A file of random samples, with transparency and a gamma that must have no effect, and its colours.
std::vector<float> write_random_png(const fs::path& file, const Kind& kind) {
    std::minstd_rand random(11);
    const auto sample = [&] { return static_cast<unsigned>(random() >> 8) & ((1u << kind.depth) - 1); };
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> out(std::fopen(file.c_str(), "wb"),
                                                              [](std::FILE* f) { return std::fclose(f); });
    REQUIRE(out != nullptr);
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_init_io(png, out.get());
    png_set_IHDR(png, info, k_width, k_height, kind.depth, kind.color_type,
                 kind.is_interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    png_set_gAMA(png, info, 1.0);
    std::array<png_color, 256> palette{};
    std::array<png_byte, 256> alpha{};
    for (png_color& color : palette)
        color = {static_cast<png_byte>(random()), static_cast<png_byte>(random()),
                 static_cast<png_byte>(random())};
    if (kind.color_type == PNG_COLOR_TYPE_PALETTE) {
        png_set_PLTE(png, info, palette.data(), 1 << kind.depth);
        png_set_tRNS(png, info, alpha.data(), 1 << kind.depth, nullptr);
    }
    png_write_info(png, info);
    png_set_packing(png);
    const std::size_t channels = kind.channels(), bytes = kind.depth == 16 ? 2 : 1;
    std::vector<png_byte> rows;
    std::vector<float> colors;
    for (int i = 0; i < k_width * k_height; ++i) {
        std::array<unsigned, 4> samples{};
        for (std::size_t c = 0; c < channels; ++c) {
            samples[c] = sample();
            if (bytes == 2) rows.push_back(static_cast<png_byte>(samples[c] >> 8));
            rows.push_back(static_cast<png_byte>(samples[c]));
        }
        const png_color& color = palette[samples[0] & 0xff];
        const std::array<unsigned, 3> of_palette{color.red, color.green, color.blue};
        for (std::size_t c = 0; c < 3; ++c) {
            if (kind.color_type == PNG_COLOR_TYPE_PALETTE) {
                colors.push_back(static_cast<float>(of_palette[c]) / 255);
            } else {
                colors.push_back(static_cast<float>(samples[channels < 3 ? 0 : c]) /
                                 static_cast<float>((1u << kind.depth) - 1));
            }
        }
    }
    std::vector<png_bytep> starts;
    for (std::size_t y = 0; y < k_height; ++y) starts.push_back(&rows[y * k_width * channels * bytes]);
    png_write_image(png, starts.data());
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    return colors;
}

}  // namespace

TEST_CASE("a PNG of any kind is read as it was written, whatever its transparency and gamma") {
    const fs::path file = scratch_directory() / "random.png";
    for (const Kind& kind : all_kinds()) {
        INFO("colour type " << kind.color_type << ", " << kind.depth << " bits"
                            << (kind.is_interlaced ? ", interlaced" : ""));
        const std::vector<float> expected = write_random_png(file, kind);
        const Decoded image = read_by("png", file);
        CHECK(image.width == k_width);
        CHECK(image.height == k_height);
        CHECK(image.is_encoded);
        CHECK((image.values == expected));
        const Decoded theirs = read_by("openimageio", file);
        CHECK(std::ranges::equal(theirs.values, image.values,
                                 [](float a, float b) { return std::abs(a - b) <= 1e-7f; }));
    }
}

TEST_CASE("a PNG that is cut off anywhere, or damaged, is an error") {
    const fs::path file = scratch_directory() / "damaged.png";
    for (const bool is_interlaced : {false, true}) {
        write_random_png(file, {PNG_COLOR_TYPE_RGB, 8, is_interlaced});
        const std::string whole = read_file(file);
        REQUIRE(problem_of("png", file).empty());
        for (std::size_t size = 0; size < whole.size(); size += size < 100 ? 1 : 97) {
            INFO(size);
            write_file(file, whole.substr(0, size));
            CHECK(problem_of("png", file) == (size < 8 ? "it is not a PNG file" : "it is cut off"));
        }
        std::string damaged = whole;
        damaged[whole.size() / 2] ^= 1;
        write_file(file, damaged);
        CHECK_FALSE(problem_of("png", file).empty());
    }
}

TEST_CASE("a PNG whose header declares more pixels than its bytes can hold is refused before it is read") {
    const fs::path file = scratch_directory() / "large.png";
    write_random_png(file, {PNG_COLOR_TYPE_GRAY, 1, false});
    const std::string whole = read_file(file);
    const fs::path image = scratch_directory() / "claimed.png";
    std::string header = whole.substr(12, 17);  // type, and 13 bytes: width and height first
    header.replace(4, 8, std::string_view("\0\0\x80\0\0\0\x80\0", 8));
    std::string checksum(4, '\0');
    const auto crc = static_cast<std::uint32_t>(
        ::crc32(0, reinterpret_cast<const Bytef*>(header.data()), static_cast<uInt>(header.size())));
    for (std::size_t i = 0; i < 4; ++i) checksum[i] = static_cast<char>(crc >> (24 - 8 * i));
    write_file(image, whole.substr(0, 12) + header + checksum + whole.substr(33));
    CHECK(holds(problem_of("png", image), "too small for its pixels"));
}

TEST_CASE("a file that is not a PNG is refused as such, and a JPEG by name") {
    const fs::path file = scratch_directory() / "other.png";
    write_file(file, "\xff\xd8\xff\xe0 the rest");
    CHECK(holds(problem_of("png", file), "JPEG"));
    write_file(file, "GIF89a and so on");
    CHECK(problem_of("png", file) == "it is not a PNG file");
    CHECK(problem_of("png", scratch_directory() / "nowhere.png") == "it cannot be opened");
}
