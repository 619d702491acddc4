#include <malloc.h>
#include <png.h>
#include <sys/mman.h>
#include <zlib.h>

#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators.hpp>
#include <catch2/generators/catch_generators_range.hpp>
#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "candela/parallel.h"
#include "support/plugins.h"
#include "support/text.h"

namespace {

using Bytes = std::vector<std::uint8_t>;

struct Image {
    int width, height;
    Bytes pixels;

    candela::ImageView view(candela::ColorEncoding encoding = candela::ColorEncoding::srgb) const {
        return {.width = width, .height = height, .encoding = encoding, .bytes = pixels};
    }
};

class Memory final : public candela::ByteSink {
  public:
    void write(std::span<const std::byte> more) override {
        for (const std::byte byte : more) bytes.push_back(static_cast<std::uint8_t>(byte));
    }
    Bytes bytes;
};

std::size_t size_of(int width, int height) {
    return 3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
}

Image flat(int width, int height) { return {width, height, Bytes(size_of(width, height), 200)}; }

Image noise(int width, int height) {
    Image picture = flat(width, height);
    std::minstd_rand random(7);
    for (std::uint8_t& value : picture.pixels) value = static_cast<std::uint8_t>(random() >> 8);
    return picture;
}

/// Like a rendered picture: increasing to the right in the upper half and downwards in the lower, with some
/// edges.
Image gradient(int width, int height) {
    Image picture = flat(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            for (int c = 0; c < 3; ++c) {
                picture.pixels[size_of(width, y) + 3 * static_cast<std::size_t>(x) +
                               static_cast<std::size_t>(c)] =
                    static_cast<std::uint8_t>((y < height / 2 ? x / 7 : y / 5) + (x + y) / 97 * 40 + c);
            }
        }
    }
    return picture;
}

Bytes png_of(const Image& picture, int compression = 1, int threads = 2,
             candela::ColorEncoding encoding = candela::ColorEncoding::srgb) {
    const auto writer =
        instance<candela::ImageFormat>("png", {{"compression", candela::Value(compression)}}, encoding);
    Memory memory;
    candela::with_threads(threads, [&] { writer->write(picture.view(encoding), "png", memory); });
    return memory.bytes;
}

/// Reads a file with libpng, without a warning.
Image read_by_libpng(const Bytes& file) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    const bool begun = png_image_begin_read_from_memory(&image, file.data(), file.size()) != 0;
    INFO(image.message);
    REQUIRE(begun);
    image.format = PNG_FORMAT_RGB;
    Image picture = flat(static_cast<int>(image.width), static_cast<int>(image.height));
    const bool read = png_image_finish_read(&image, nullptr, picture.pixels.data(), 0, nullptr) != 0;
    INFO(image.message);
    REQUIRE(read);
    REQUIRE(image.warning_or_error == 0);
    return picture;
}

std::uint32_t number_at(const Bytes& file, std::size_t place) {
    return static_cast<std::uint32_t>(file.at(place) << 24 | file.at(place + 1) << 16 |
                                      file.at(place + 2) << 8 | file.at(place + 3));
}

struct Chunk {
    std::string type;
    Bytes contents;
};

/// The chunks after the signature; each must have the right checksum.
std::vector<Chunk> chunks_of(const Bytes& file) {
    std::vector<Chunk> chunks;
    for (std::size_t place = 8; place < file.size();) {
        const std::size_t size = number_at(file, place);
        REQUIRE(place + 12 + size <= file.size());
        const std::uint8_t* const type = &file[place + 4];
        REQUIRE(number_at(file, place + 8 + size) == crc32(0, type, static_cast<uInt>(size + 4)));
        chunks.push_back({std::string(type, type + 4), Bytes(type + 4, type + 4 + size)});
        place += 12 + size;
    }
    return chunks;
}

/// The chunks must contain a single zlib stream, with the right checksum at its end and nothing after it.
void check_stream(const std::vector<Chunk>& chunks, const Image& picture) {
    Bytes stream;
    for (const Chunk& chunk : chunks) {
        if (chunk.type == "IDAT") stream.insert(stream.end(), chunk.contents.begin(), chunk.contents.end());
    }
    Bytes rows(picture.pixels.size() + static_cast<std::size_t>(picture.height) + 1);
    uLongf size = rows.size();
    uLong used = stream.size();
    REQUIRE(uncompress2(rows.data(), &size, stream.data(), &used) == Z_OK);
    CHECK(size == rows.size() - 1);
    CHECK(used == stream.size());
}

std::string types_of(const std::vector<Chunk>& chunks) {
    std::string types;
    for (const Chunk& chunk : chunks) {
        if (!types.ends_with(chunk.type)) types += " " + chunk.type;
    }
    return types;
}

void check_round_trip(const Image& picture, int compression) {
    INFO(picture.width << " x " << picture.height << ", compression " << compression);
    const Bytes file = png_of(picture, compression);
    const std::vector<Chunk> chunks = chunks_of(file);
    CHECK(types_of(chunks) == " IHDR sRGB IDAT IEND");
    check_stream(chunks, picture);
    const Image back = read_by_libpng(file);
    REQUIRE(back.width == picture.width);
    REQUIRE(back.height == picture.height);
    CHECK((back.pixels == picture.pixels));
}

/// Some consist of one band, some of two or more: a band has about 256 kB, but at least one row.
constexpr std::pair<int, int> k_sizes[] = {{1, 1},       {1, 700},     {700, 1},   {2, 3},
                                           {333, 217},   {256, 341},   {256, 342}, {257, 343},
                                           {1, 100'000}, {100'001, 3}, {641, 479}};

/// A disk with room for a limited number of bytes.
class FullDisk final : public candela::ByteSink {
  public:
    explicit FullDisk(std::size_t room) : room_(room) {}
    void write(std::span<const std::byte> bytes) override {
        if (bytes.size() > room_) throw std::runtime_error("the disk is full");
        room_ -= bytes.size();
    }

  private:
    std::size_t room_;
};

}  // namespace

TEST_CASE("a PNG preserves every bit of the pixels, whatever its size, compression and content") {
    const int compression = GENERATE(range(0, 10));
    for (const auto& [width, height] : k_sizes) {
        check_round_trip(flat(width, height), compression);
        check_round_trip(noise(width, height), compression);
        check_round_trip(gradient(width, height), compression);
    }
}

TEST_CASE("a PNG is the same to the byte for any number of threads") {
    const int compression = GENERATE(0, 1, 6);
    for (const Image& picture : {noise(641, 1023), gradient(1920, 1080)}) {
        const Bytes one = png_of(picture, compression, 1);
        for (const int threads : {2, 8}) {
            for (int again = 0; again < 5; ++again) CHECK((png_of(picture, compression, threads) == one));
        }
    }
}

TEST_CASE("a PNG is the same to the byte wherever its compressor lies in memory") {
    Image dark{16, 8, Bytes(size_of(16, 8), 0)};
    struct Spot {
        std::size_t x, y;
        std::uint8_t gray;
    };
    for (const Spot& spot : {Spot{6, 3, 44}, Spot{7, 3, 44}, Spot{8, 3, 37}, Spot{6, 4, 44}, Spot{7, 4, 44},
                             Spot{8, 4, 30}, Spot{7, 5, 37}, Spot{8, 5, 37}})
        std::fill_n(&dark.pixels[3 * (16 * spot.y + spot.x)], 3, spot.gray);
    // Large blocks get their own mappings, so that the next compressor lies at another address.
    mallopt(M_MMAP_THRESHOLD, 1 << 16);
    const Bytes file = png_of(dark, 1, 1);
    int differing = 0;
    std::vector<void*> taken(4000);
    for (void*& place : taken) {
        if (png_of(dark, 1, 1) != file) ++differing;
        place = mmap(nullptr, 1 << 16, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    }
    for (void* const place : taken) munmap(place, 1 << 16);
    CHECK(differing == 0);
}

TEST_CASE("a PNG does not grow with its compression level") {
    const Image picture = gradient(1280, 720);
    std::size_t before = png_of(picture, 0).size();
    CHECK(before > picture.pixels.size());
    CHECK(before < picture.pixels.size() + picture.pixels.size() / 500);
    for (const int compression : {1, 6, 9}) {
        const std::size_t size = png_of(picture, compression).size();
        CHECK(size <= before);
        before = size;
    }
    CHECK(png_of(noise(1280, 720)).size() < picture.pixels.size() + picture.pixels.size() / 500);
}

TEST_CASE("a PNG is marked as sRGB only if it is") {
    const Image picture = gradient(30, 20);
    const Bytes file = png_of(picture, 1, 1, candela::ColorEncoding::none);
    CHECK(types_of(chunks_of(file)) == " IHDR IDAT IEND");
    const std::vector<Chunk> chunks = chunks_of(png_of(picture));
    CHECK(chunks.at(1).type == "sRGB");
    CHECK(chunks.at(1).contents == Bytes{0});
}

TEST_CASE("an exception from a PNG's sink propagates, wherever the disk is full") {
    const Image picture = noise(641, 479);
    const std::size_t size = png_of(picture).size();
    const auto writer = instance<candela::ImageFormat>("png");
    for (const std::size_t room : {std::size_t{0}, std::size_t{100}, size / 2, size - 1}) {
        FullDisk disk(room);
        INFO("room for " << room << " of " << size);
        CHECK(message_of<std::runtime_error>([&] { writer->write(picture.view(), "png", disk); }) ==
              "the disk is full");
    }
    FullDisk disk(size);
    CHECK_NOTHROW(writer->write(picture.view(), "png", disk));
}

TEST_CASE("a picture that a PNG cannot hold is refused") {
    const auto writer = instance<candela::ImageFormat>("png");
    const Image whole = flat(4, 4);
    for (const auto& [width, height] : {std::pair{0, 4}, {4, 0}, {-4, 4}, {4, 5}}) {
        Memory memory;
        candela::ImageView view = whole.view();
        view.width = width;
        view.height = height;
        CHECK_THROWS_AS(writer->write(view, "png", memory), std::runtime_error);
        CHECK(memory.bytes.empty());
    }
}
