#include <catch2/catch_test_macros.hpp>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

import candela.core;

TEST_CASE(
    "numbers are all equal unless one differs, wherever and in whichever bit, with every instruction set") {
    const candela::InstructionSet before = candela::instruction_set();
    for (const candela::InstructionSet set : candela::k_instruction_sets) {
        if (!candela::use_instruction_set(set)) continue;
        CHECK(candela::are_all_equal(std::span<const std::uint32_t>()));
        for (std::size_t count = 1; count <= 70; ++count) {
            INFO(candela::name_of(set) << ", " << count);
            std::vector<std::uint32_t> numbers(count, 0x80000001u);
            std::vector<std::int32_t> with_sign(count, -5);
            REQUIRE(candela::are_all_equal(std::span<const std::uint32_t>(numbers)));
            REQUIRE(candela::are_all_equal(std::span<const std::int32_t>(with_sign)));
            for (std::size_t i = 0; count > 1 && i < count; ++i) {
                numbers[i] ^= 1u << (i % 32);
                with_sign[i] = 5;
                REQUIRE_FALSE(candela::are_all_equal(std::span<const std::uint32_t>(numbers)));
                REQUIRE_FALSE(candela::are_all_equal(std::span<const std::int32_t>(with_sign)));
                numbers[i] = 0x80000001u;
                with_sign[i] = -5;
            }
        }
    }
    candela::use_instruction_set(before);
}
