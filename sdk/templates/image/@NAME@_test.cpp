#include <candela/plugin_test.h>

#include <array>
#include <catch2/catch_test_macros.hpp>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace {

class Memory final : public candela::ByteSink {
  public:
    void write(std::span<const std::byte> bytes) override {
        for (const std::byte b : bytes) text += static_cast<char>(b);
    }
    std::string text;
};

}  // namespace

TEST_CASE("two pixels next to each other are a header and six bytes") {
    const auto format = candela::sdk::make<candela::ImageFormat>(CANDELA_PLUGIN_DIR, "@NAME@");
    const std::array<std::uint8_t, 6> pixels{'a', 'b', 'c', 'd', 'e', 'f'};
    Memory memory;
    format->write({.width = 2, .height = 1, .bytes = pixels}, "@NAME@", memory);
    CHECK(memory.text == "@NAME@ 2 1\nabcdef");
}
