#include <candela/plugin_test.h>

#include <catch2/catch_test_macros.hpp>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace {

class Memory final : public candela::ByteSink {
  public:
    void write(std::span<const std::byte> bytes) override {
        for (const std::byte b : bytes) written.push_back(static_cast<std::uint8_t>(b));
    }
    std::vector<std::uint8_t> written;
};

/// The chunks of a picture of one row, between header and end mark.
std::vector<std::uint8_t> chunks_of(const std::vector<std::uint8_t>& pixels) {
    const auto format = candela::sdk::make<candela::ImageFormat>(CANDELA_PLUGIN_DIR, "qoi");
    Memory memory;
    format->write({.width = static_cast<int>(pixels.size() / 3), .height = 1, .bytes = pixels}, "qoi",
                  memory);
    REQUIRE(memory.written.size() >= 22);
    return {memory.written.begin() + 14, memory.written.end() - 8};
}

using Bytes = std::vector<std::uint8_t>;

}  // namespace

TEST_CASE(
    "the header is 'qoif', width and height with the highest byte first, 3 channels, sRGB; the end is seven "
    "0 and a 1") {
    const auto format = candela::sdk::make<candela::ImageFormat>(CANDELA_PLUGIN_DIR, "qoi");
    Memory memory;
    const Bytes black(std::size_t{3} * 300 * 2);
    format->write({.width = 300, .height = 2, .bytes = black}, "qoi", memory);
    const Bytes& file = memory.written;
    CHECK(Bytes(file.begin(), file.begin() + 14) == Bytes{'q', 'o', 'i', 'f', 0, 0, 1, 44, 0, 0, 0, 2, 3, 0});
    CHECK(Bytes(file.end() - 8, file.end()) == Bytes{0, 0, 0, 0, 0, 0, 0, 1});
}

// The specification's chunks, section by section.
TEST_CASE("QOI_OP_RUN: the first pixel's predecessor is black, and a chunk holds at most 62 pixels") {
    CHECK(chunks_of(Bytes(3 * 62)) == Bytes{0xc0 | 61});
    CHECK(chunks_of(Bytes(3 * 64)) == Bytes{0xc0 | 61, 0xc0 | 1});
}
TEST_CASE("QOI_OP_DIFF: differences of -2 to 1, around zero as well, with a bias of 2") {
    CHECK(chunks_of({1, 255, 254}) == Bytes{0x40 | 3 << 4 | 1 << 2 | 0});
}
TEST_CASE("QOI_OP_LUMA: green by -32 to 31, with red and blue relative to it by -8 to 7") {
    CHECK(chunks_of({20, 25, 32}) == Bytes{0x80 | (25 + 32), (20 - 25 + 8) << 4 | (32 - 25 + 8)});
}
TEST_CASE("QOI_OP_RGB: any other pixel, uncompressed") {
    CHECK(chunks_of({100, 200, 50}) == Bytes{0xfe, 100, 200, 50});
}
TEST_CASE("QOI_OP_INDEX: an earlier pixel is stored as its index, (3 r + 5 g + 7 b + 11 a) mod 64") {
    const auto place = static_cast<std::uint8_t>((100 * 3 + 200 * 5 + 50 * 7 + 255 * 11) % 64);
    CHECK(chunks_of({100, 200, 50, 0, 90, 0, 100, 200, 50}) ==
          Bytes{0xfe, 100, 200, 50, 0xfe, 0, 90, 0, place});
}
