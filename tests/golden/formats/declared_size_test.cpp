// Textures of a few bytes that declare millions of pixels.
#include <sys/resource.h>

#include <catch2/catch_test_macros.hpp>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "support/command.h"
#include "support/expect.h"
#include "support/sanitizers.h"
#include "support/text.h"

namespace fs = std::filesystem;

namespace {

void put(std::string& bytes, std::uint32_t value, int count) {
    for (int i = 0; i < count; ++i) bytes += static_cast<char>(value >> 8 * i & 0xff);
}

struct Tag {
    std::uint32_t number, value;
};

/// A little-endian TIFF file of one grey channel, without the pixels. `more`: tags in order, after that of
/// the channels (277).
std::string tiff(std::uint32_t width, std::uint32_t height, std::uint32_t compression,
                 const std::vector<Tag>& more) {
    std::vector<Tag> tags = {{256, width}, {257, height}, {258, 8}, {259, compression}, {262, 1}, {277, 1}};
    tags.insert(tags.end(), more.begin(), more.end());
    std::string bytes("II*\0\x08\0\0\0", 8);
    put(bytes, static_cast<std::uint32_t>(tags.size()), 2);
    for (const Tag& tag : tags) {
        put(bytes, tag.number, 2);
        put(bytes, 4, 2);  // a LONG
        put(bytes, 1, 4);
        put(bytes, tag.value, 4);
    }
    put(bytes, 0, 4);
    return bytes;
}

std::string webp(std::uint32_t width, std::uint32_t height) {
    std::string image = "/";
    put(image, width - 1 | (height - 1) << 14, 4);
    image += std::string(5, '\0');
    std::string bytes = "RIFF";
    put(bytes, static_cast<std::uint32_t>(12 + image.size()), 4);
    bytes += "WEBPVP8L";
    put(bytes, static_cast<std::uint32_t>(image.size()), 4);
    return bytes + image;
}

/// An RLE-compressed BMP file of 8 bits a pixel, without the pixels.
std::string bmp(std::int32_t width, std::int32_t height) {
    std::string bytes = "BM";
    for (const std::uint32_t value :
         {54u, 0u, 54u, 40u, static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height),
          1u | 8u << 16, 1u, 0u, 0u, 0u, 0u, 0u})
        put(bytes, value, 4);
    return bytes;
}

/// An OpenEXR file whose first attribute declares 1.7 GB of text.
std::string exr(std::uint32_t flags) {
    std::string bytes = "v/1\x01";
    put(bytes, 2 | flags, 4);
    bytes += std::string("comments\0string\0", 16);
    put(bytes, 1'700'000'000, 4);
    return bytes + "text";
}

/// Renders with the file as a texture, within five seconds of processor time and a gigabyte and a half.
CommandResult rendered_with(const std::string& name, const std::string& bytes) {
    const fs::path folder = scratch_directory();
    write_file(folder / name, bytes);
    write_file(folder / "scene.toml",
               "version = 1\nobserver = {position = [0, 0, 4], look_at = [0, 0, 0]}\nshading = {model = "
               "\"phong\"}\nreflection = {model = \"lambert\"}\nlight = [{type = \"ambient\"}]\n"
               "object = [{type = \"sphere\", color = {texture = \"" +
                   name + "\"}}]\n");
    CommandSetup setup{.directory = folder};
    setup.prepare = [] {
        const rlimit time{5, 5}, memory{rlim_t{1500} << 20, rlim_t{1500} << 20};
        if (k_has_shadow_memory) return;
        ::setrlimit(RLIMIT_CPU, &time);
        ::setrlimit(RLIMIT_AS, &memory);
    };
    return run_candela({"render", "scene.toml", "-o", "a.ppm", "--threads", "2"}, setup);
}

}  // namespace

TEST_CASE("a file of a few bytes that declares millions of pixels is refused before anything is decoded") {
    constexpr std::uint32_t k_uncompressed = 1, k_packed = 32773;
    const std::vector<std::pair<std::string, std::string>> files = {
        {"tiles.tif", tiff(20000, 20000, k_uncompressed, {{322, 20000}, {323, 20000}, {324, 8}, {325, 100}})},
        {"tile.tif", tiff(10, 10, k_uncompressed, {{322, 20000}, {323, 20000}, {324, 8}, {325, 100}})},
        {"strip.tif", tiff(20000, 20000, k_packed, {{273, 8}, {278, 20000}, {279, 100}})},
        {"strips.tif", tiff(20000, 20000, k_uncompressed, {{273, 8}, {278, 1}, {279, 100}})},
        {"wide.tga", std::string("\0\0\x0a\0\0\0\0\0\0\0\0\0\xff\xff\xff\xff\x18\0\xff\1\2\3abc", 25)},
        {"high.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 60000 +X 30000\n\2\2"},
        {"large.webp", webp(16383, 16383)},
        {"upright.bmp", bmp(20000, 65536)},
        {"inverted.bmp", bmp(20000, -65536)},
    };
    for (const auto& [name, bytes] : files) {
        const CommandResult result = rendered_with(name, bytes);
        INFO(name << ", " << bytes.size() << " bytes: " << result.err);
        CHECK(result.exit_code == 1);
        CHECK(holds(result.err, "too small for its pixels"));
    }
}

TEST_CASE("an OpenEXR file whose header declares more bytes than it has is refused") {
    constexpr std::uint32_t k_one_part = 0, k_multipart = 0x1000;
    for (const std::uint32_t flags : {k_one_part, k_multipart}) {
        expect(rendered_with("text.exr", exr(flags)), 1,
               {"its header declares more bytes than the file has"});
    }
}

TEST_CASE("a pixmap of a few bytes is recognised, whatever its name, and refused at once") {
    expect(rendered_with("pixmap.tif", "P6 20000 20000 255\nabcdef"), 1, {"it ends before its last pixel"});
}

TEST_CASE("tiles as large as the picture are decoded once, not once for each row") {
    // 1200 rows in one tile: row by row, 1200 times 1.4 million pixels.
    constexpr std::uint32_t k_side = 1200;
    std::string bytes =
        tiff(k_side, k_side, 1, {{322, k_side}, {323, k_side}, {324, 134}, {325, k_side * k_side}});
    REQUIRE(bytes.size() == 134);
    bytes += std::string(std::size_t{k_side} * k_side, '\x80');
    expect(rendered_with("tile.tif", bytes), 0);
}

TEST_CASE("a file that only claims to be a picture is refused without trying every format") {
    const std::string unknown = "its content is not a picture of a known format";
    for (const auto& [bytes, reason] :
         {std::pair(std::string("GIF89a\1\0\1\0\0\0\0"), unknown), {"hello", unknown}, {"", "it is empty"}}) {
        expect(rendered_with("a.tif", bytes), 1, {reason});
    }
}
