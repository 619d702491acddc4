// On a mesh finer than the picture, every second triangle covers no sample, in an order that branch
// predictors cannot learn: hence sixteen at a time, without branches.
module;

#include "candela/kernel/simd_dispatch.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

module candela.raster;

import :binning;
import :bounds;
import :culling;
import candela.util;

namespace candela {

namespace {

/// One bit for each of sixteen triangles.
struct CulledSixteen {
    std::uint32_t kept = 0, reversed = 0, clipped = 0;
};

struct CullLoop {
    CANDELA_BATCH_LOOP static void run(IndexedTriangles triangles, std::size_t first, SampleBounds bounds,
                                       Culling* out) {
        std::uint64_t kept = 0, reversed = 0, clipped = 0;
        for (std::size_t i = 0; i < Culling::k_size && first + i < triangles.count; i += k_lanes) {
            const CulledSixteen some = look_at_some(triangles, first + i, bounds, i, out);
            kept |= std::uint64_t{some.kept} << i;
            reversed |= std::uint64_t{some.reversed} << i;
            clipped |= std::uint64_t{some.clipped} << i;
        }
        out->kept = kept;
        out->reversed = reversed;
        out->clipped = clipped;
    }

  private:
    [[gnu::always_inline]] static CulledSixteen look_at_some(const IndexedTriangles& triangles,
                                                             std::size_t first, SampleBounds bounds,
                                                             std::size_t at, Culling* out) {
        const std::size_t count = std::min(triangles.count - first, k_lanes);
        const auto corner = [&](std::size_t lane, std::size_t k) {
            const std::size_t t = first + (lane < count ? lane : count - 1);
            return &triangles.screen[triangles.indices[3 * t + k]];
        };
        // Counter-clockwise in the world, y up, is clockwise on the screen, y down.
        Columns a, b, c;
        a.gather([&](std::size_t lane) { return corner(lane, 0); });
        b.gather([&](std::size_t lane) { return corner(lane, 2); });
        c.gather([&](std::size_t lane) { return corner(lane, 1); });
        const bool two_sided = triangles.two_sided;
        std::uint32_t kept = 0, reversed = 0, clipped = 0;
        CANDELA_VECTORIZE_SIXTEEN
        for (std::size_t lane = 0; lane < k_lanes; ++lane) {
            const std::int32_t ax = a.integer(0, lane), ay = a.integer(1, lane);
            const std::int32_t bx = b.integer(0, lane), by = b.integer(1, lane);
            const std::int32_t cx = c.integer(0, lane), cy = c.integer(1, lane);
            const std::int32_t left = least(ax, bx, cx), right = most(ax, bx, cx);
            const std::int32_t top = least(ay, by, cy), bottom = most(ay, by, cy);
            out->left[at + lane] = left;
            out->right[at + lane] = right;
            out->top[at + lane] = top;
            out->bottom[at + lane] = bottom;
            // Exact, as the factors have at most 24 bits.
            const double area = static_cast<double>(bx - ax) * static_cast<double>(cy - ay) -
                                static_cast<double>(cx - ax) * static_cast<double>(by - ay);
            const std::int32_t outside_a = a.integer(3, lane), outside_b = b.integer(3, lane),
                               outside_c = c.integer(3, lane);
            const auto all = static_cast<std::uint32_t>(outside_a & outside_b & outside_c);
            const auto any = static_cast<std::uint32_t>(outside_a | outside_b | outside_c);
            const bool is_there = (lane < count) & ((all & Outside::view) == 0);
            const bool is_far = (any & Outside::guard) != 0;
            const bool has_area = (area > 0) | ((area < 0) & two_sided);
            const bool misses_columns = bounds.misses(left, right, bounds.width);
            const bool misses_rows = bounds.misses(top, bottom, bounds.height);
            const bool is_within = is_there & ((any & (Outside::guard | Outside::nowhere)) == 0);
            const bool is_kept = is_within & has_area & !misses_columns & !misses_rows;
            const bool is_clipped = is_there & is_far;
            const std::uint32_t bit = 1u << lane;
            kept |= is_kept ? bit : 0u;
            reversed |= area < 0 ? bit : 0u;
            clipped |= is_clipped ? bit : 0u;
        }
        return {kept, reversed, clipped};
    }
};

}  // namespace

void Culling::look_at(const IndexedTriangles& triangles, std::size_t first, const SampleBounds& bounds) {
    Culling* const out = this;
    multiversion<CullLoop>(triangles, first, bounds, out);
}

}  // namespace candela
