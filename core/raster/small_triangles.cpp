// Rasterises triangles about a pixel large, many at once: meshes finer than the picture consist of them.
module;

#include "candela/kernel/simd_dispatch.h"

#include <cstddef>
#include <cstdint>

module candela.raster;

import :bounds;
import :small_triangles;
import candela.util;

namespace candela {

namespace {

/// An edge from one vertex to the next, as an edge function: >= 0 inside.
struct Edge {
    std::int32_t at_first, to_right, down;

    /// Everything relative to the first sample; `one`: a pixel.
    [[gnu::always_inline]] Edge(std::int32_t x, std::int32_t y, std::int32_t next_x, std::int32_t next_y,
                                std::int32_t one) {
        const std::int32_t dx = next_x - x, dy = next_y - y;
        const bool owns_its_samples = (dy < 0) | ((dy == 0) & (dx > 0));  // a left or a top edge
        at_first = dy * x - dx * y - (owns_its_samples ? 0 : 1);
        to_right = -dy * one;
        down = dx * one;
    }
};

/// Coverage of four samples of a row, as bits.
[[gnu::always_inline]] inline std::uint32_t covered_of_row(const Edge& a, const Edge& b, const Edge& c,
                                                           std::int32_t row) {
    const std::int32_t ea = a.at_first + row * a.down, eb = b.at_first + row * b.down,
                       ec = c.at_first + row * c.down;
    const std::int32_t o0 = ea | eb | ec;
    const std::int32_t o1 = (ea + a.to_right) | (eb + b.to_right) | (ec + c.to_right);
    const std::int32_t o2 = (ea + 2 * a.to_right) | (eb + 2 * b.to_right) | (ec + 2 * c.to_right);
    const std::int32_t o3 = (ea + 3 * a.to_right) | (eb + 3 * b.to_right) | (ec + 3 * c.to_right);
    return ((o0 >= 0 ? 1u : 0u) | (o1 >= 0 ? 2u : 0u) | (o2 >= 0 ? 4u : 0u) | (o3 >= 0 ? 8u : 0u))
           << (4 * row);
}

/// The pixels whose samples a triangle may cover.
struct Box {
    std::int32_t x, y;  // of its first pixel
    bool is_small, is_tall, has_next_block;
    // The vertices relative to that pixel's sample; zero for a large triangle, to avoid overflow.
    std::int32_t ux, uy, vx, vy, wx, wy;

    [[gnu::always_inline]] Box(std::int32_t ax, std::int32_t ay, std::int32_t bx, std::int32_t by,
                               std::int32_t cx, std::int32_t cy, bool is_piece, int bits) {
        const std::int32_t one = 1 << bits, half = one / 2;
        x = (least(ax, bx, cx) + half - 1) >> bits;
        y = (least(ay, by, cy) + half - 1) >> bits;
        const std::int32_t wide = ((most(ax, bx, cx) - half) >> bits) - x;
        const std::int32_t high = ((most(ay, by, cy) - half) >> bits) - y;
        is_tall = high > 3;
        is_small = (wide <= (is_tall ? 3 : 7)) & (high <= 7) & !is_piece;
        has_next_block = is_small & ((wide > 3) | is_tall);
        const std::int32_t sx = x * one + half, sy = y * one + half;
        ux = is_small ? ax - sx : 0, uy = is_small ? ay - sy : 0;
        vx = is_small ? bx - sx : 0, vy = is_small ? by - sy : 0;
        wx = is_small ? cx - sx : 0, wy = is_small ? cy - sy : 0;
    }

    /// The samples of four by four pixels from the first one on, or of the next block, four pixels below or
    /// to the right.
    [[gnu::always_inline]] std::uint32_t covered(std::int32_t one, bool is_next) const {
        const std::int32_t right = (is_next & !is_tall) ? 4 * one : 0;
        const std::int32_t below = (is_next & is_tall) ? 4 * one : 0;
        const Edge a(ux - right, uy - below, vx - right, vy - below, one);
        const Edge b(vx - right, vy - below, wx - right, wy - below, one);
        const Edge c(wx - right, wy - below, ux - right, uy - below, one);
        return covered_of_row(a, b, c, 0) | covered_of_row(a, b, c, 1) | covered_of_row(a, b, c, 2) |
               covered_of_row(a, b, c, 3);
    }
};

struct SmallLoop {
    CANDELA_BATCH_LOOP static void run(const ScreenVertex* screen, const BinnedTriangle* triangles,
                                       std::size_t count, int bits, SmallTriangles* out) {
        for (std::size_t first = 0; first < count; first += k_lanes)
            run_some(screen, triangles, first, count, bits, out);
    }

  private:
    /// Sixteen from `first` on; if there are fewer, the last is repeated.
    [[gnu::always_inline]] static void run_some(const ScreenVertex* screen, const BinnedTriangle* triangles,
                                                std::size_t first, std::size_t count, int bits,
                                                SmallTriangles* out) {
        const ScreenVertex* vertex[3][k_lanes];
        std::int32_t is_piece[k_lanes];
// One by one: they become addresses, not vectors.
#pragma clang loop unroll(disable) vectorize(disable)
        for (std::size_t lane = 0; lane < k_lanes; ++lane) {
            const BinnedTriangle& t = triangles[first + lane < count ? first + lane : count - 1];
            is_piece[lane] = t.is_piece() ? 1 : 0;
            for (std::size_t k = 0; k < 3; ++k) vertex[k][lane] = screen + (t.is_piece() ? 0 : t.vertex[k]);
        }
        Columns of_a, of_b, of_c;
        of_a.gather([&](std::size_t i) { return vertex[0][i]; });
        of_b.gather([&](std::size_t i) { return vertex[1][i]; });
        of_c.gather([&](std::size_t i) { return vertex[2][i]; });
        const std::int32_t one = 1 << bits;
        std::int32_t next_blocks = 0;
        CANDELA_VECTORIZE_SIXTEEN
        for (std::size_t lane = 0; lane < k_lanes; ++lane) {
            const std::size_t i = first + lane;
            const Box box = box_of(of_a, of_b, of_c, lane, is_piece[lane] != 0, bits);
            next_blocks |= box.has_next_block ? 1 : 0;
            out->is_small[i] = box.is_small ? 1 : 0;
            out->is_tall[i] = box.is_tall ? 1 : 0;
            out->x[i] = box.x;
            out->y[i] = box.y;
            out->covered[i] = box.covered(one, false);

            const float z = of_a.real[2][lane], zv = of_b.real[2][lane] - z, zw = of_c.real[2][lane] - z;
            const auto dvx = static_cast<float>(box.vx - box.ux), dvy = static_cast<float>(box.vy - box.uy);
            const auto dwx = static_cast<float>(box.wx - box.ux), dwy = static_cast<float>(box.wy - box.uy);
            const float area = dvx * dwy - dwx * dvy;
            const float inverse = 1 / (area > 0 ? area : 1.0f);
            const float zx = (zv * dwy - zw * dvy) * inverse, zy = (zw * dvx - zv * dwx) * inverse;
            out->depth[i] = z - zx * static_cast<float>(box.ux) - zy * static_cast<float>(box.uy);
            out->to_right[i] = zx * static_cast<float>(one);
            out->down[i] = zy * static_cast<float>(one);
        }
        if (next_blocks == 0) return;
        CANDELA_VECTORIZE_SIXTEEN
        for (std::size_t lane = 0; lane < k_lanes; ++lane) {
            const Box box = box_of(of_a, of_b, of_c, lane, is_piece[lane] != 0, bits);
            out->covered[first + lane] |= box.covered(one, true) << 16;
        }
    }

    [[gnu::always_inline]] static Box box_of(const Columns& a, const Columns& b, const Columns& c,
                                             std::size_t lane, bool is_piece, int bits) {
        return {a.integer(0, lane), a.integer(1, lane), b.integer(0, lane), b.integer(1, lane),
                c.integer(0, lane), c.integer(1, lane), is_piece,           bits};
    }
};

}  // namespace

void SmallTriangles::set_up(const ScreenVertex* screen, const BinnedTriangle* triangles, std::size_t count,
                            int subpixel_bits) {
    SmallTriangles* const out = this;
    multiversion<SmallLoop>(screen, triangles, count, subpixel_bits, out);
}

}  // namespace candela
