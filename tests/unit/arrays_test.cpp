#include "candela/kernel/simd_dispatch.h"

#include <algorithm>
#include <array>
#include <catch2/catch_test_macros.hpp>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "support/plugins.h"

namespace {

struct Record {
    float a, b;
    std::int32_t c;
    float d;
};

struct GatherLoop {
    CANDELA_BATCH_LOOP static void run(const Record* records, const std::size_t* numbers,
                                       candela::Columns* columns) {
        columns->gather([&](std::size_t i) { return &records[numbers[i]].a; });
    }
};

}  // namespace

TEST_CASE("an aligned vector begins at a cache line and with zeros, and keeps its contents when it grows") {
    for (const std::size_t size : {1u, 3u, 16u, 1000u, 100'000u, 3'000'000u}) {
        candela::AlignedVector<float> vector(size);
        CHECK(reinterpret_cast<std::uintptr_t>(vector.data()) % 64 == 0);
        CHECK(std::ranges::all_of(vector, [](float x) { return x == 0; }));
        std::ranges::fill(vector, 7.0f);
        vector.resize(3 * size);
        CHECK(reinterpret_cast<std::uintptr_t>(vector.data()) % 64 == 0);
        CHECK(std::ranges::count(vector, 7.0f) == static_cast<std::ptrdiff_t>(size));
        CHECK(std::ranges::count(vector, 0.0f) == static_cast<std::ptrdiff_t>(2 * size));
    }
}

TEST_CASE("sixteen records fetched from anywhere become columns in order, with every instruction set") {
    std::vector<Record> records;
    for (int i = 0; i < 40; ++i) {
        const auto x = static_cast<float>(i);
        records.push_back({.a = x, .b = 100 + x, .c = i == 7 ? -1 : 1 << (i % 31), .d = -x});
    }
    const std::array<std::size_t, 16> of = {7, 0, 39, 12, 12, 3, 31, 8, 1, 22, 5, 38, 0, 17, 30, 2};
    for (const candela::InstructionSet set : machine_instruction_sets()) {
        INFO(candela::name_of(set));
        REQUIRE(candela::use_instruction_set(set));
        candela::Columns columns{};
        const Record* const all = records.data();
        const std::size_t* const numbers = of.data();
        candela::Columns* const out = &columns;
        candela::multiversion<GatherLoop>(all, numbers, out);
        for (std::size_t i = 0; i < of.size(); ++i) {
            const Record& expected = records[of[i]];
            CHECK(columns.real[0][i] == expected.a);
            CHECK(columns.real[1][i] == expected.b);
            CHECK(columns.integer(2, i) == expected.c);
            CHECK(columns.real[3][i] == expected.d);
        }
    }
    candela::use_instruction_set(candela::best_instruction_set());
}
