// Perspective-correct interpolation between the corners of triangles.
module;

#include "candela/multiversion.h"

#include <cstddef>

module candela.fragments;

namespace candela {

namespace {

/// One fragment of one triangle. Corner k is at (x, y, w)_k, homogeneous pixels.
struct Fragment {
    float b0, b1, b2;

    [[gnu::always_inline]] Fragment(float px, float py, float x0, float y0, float w0, float x1, float y1,
                                    float w1, float x2, float y2, float w2) {
        // Corners relative to the fragment; areas of the three part triangles, perspective already undone by
        // w.
        x0 -= px * w0, y0 -= py * w0;
        x1 -= px * w1, y1 -= py * w1;
        x2 -= px * w2, y2 -= py * w2;
        b0 = x1 * y2 - x2 * y1;
        b1 = x2 * y0 - x0 * y2;
        b2 = x0 * y1 - x1 * y0;
        // On the triangle, also where its fixed-point image reaches a hair further than the triangle.
        const float sign = b0 + b1 + b2 < 0.0f ? -1.0f : 1.0f;
        b0 = b0 * sign > 0.0f ? b0 * sign : 0.0f;
        b1 = b1 * sign > 0.0f ? b1 * sign : 0.0f;
        b2 = b2 * sign > 0.0f ? b2 * sign : 0.0f;
        const float sum = b0 + b1 + b2;
        const float scale = 1.0f / (sum > 0.0f ? sum : 1.0f);
        b0 = sum > 0.0f ? b0 * scale : 1.0f;
        b1 = b1 * scale;
        b2 = b2 * scale;
    }

    [[gnu::always_inline]] float blend(float at_0, float at_1, float at_2) const {
        return b0 * at_0 + b1 * at_1 + b2 * at_2;
    }
};

struct RunLoop {
    CANDELA_BATCH_LOOP static void run(TriangleAttributes t, std::size_t count, const float* px,
                                       const float* py, InterpolatedSpans out) {
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) {
            const Fragment f(px[i], py[i], t.x[0], t.y[0], t.w[0], t.x[1], t.y[1], t.w[1], t.x[2], t.y[2],
                             t.w[2]);
            out.barycentric.x[i] = f.b0;
            out.barycentric.y[i] = f.b1;
            out.barycentric.z[i] = f.b2;
            out.position.x[i] = f.blend(t.position[0].x, t.position[1].x, t.position[2].x);
            out.position.y[i] = f.blend(t.position[0].y, t.position[1].y, t.position[2].y);
            out.position.z[i] = f.blend(t.position[0].z, t.position[1].z, t.position[2].z);
            out.vertex_normal.x[i] = f.blend(t.normal[0].x, t.normal[1].x, t.normal[2].x);
            out.vertex_normal.y[i] = f.blend(t.normal[0].y, t.normal[1].y, t.normal[2].y);
            out.vertex_normal.z[i] = f.blend(t.normal[0].z, t.normal[1].z, t.normal[2].z);
        }
    }
};

/// The rows of TriangleLanes are the members of TriangleAttributes in their order.
struct LaneLoop {
    CANDELA_BATCH_LOOP static void run(const float (*n)[TriangleLanes::k_lanes], std::size_t count,
                                       const float* px, const float* py, InterpolatedSpans out) {
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) {
            const Fragment f(px[i], py[i], n[0][i], n[3][i], n[6][i], n[1][i], n[4][i], n[7][i], n[2][i],
                             n[5][i], n[8][i]);
            out.barycentric.x[i] = f.b0;
            out.barycentric.y[i] = f.b1;
            out.barycentric.z[i] = f.b2;
            out.position.x[i] = f.blend(n[9][i], n[12][i], n[15][i]);
            out.position.y[i] = f.blend(n[10][i], n[13][i], n[16][i]);
            out.position.z[i] = f.blend(n[11][i], n[14][i], n[17][i]);
            out.vertex_normal.x[i] = f.blend(n[18][i], n[21][i], n[24][i]);
            out.vertex_normal.y[i] = f.blend(n[19][i], n[22][i], n[25][i]);
            out.vertex_normal.z[i] = f.blend(n[20][i], n[23][i], n[26][i]);
        }
    }
};

}  // namespace

void interpolate(const TriangleAttributes& triangle, std::size_t count, const float* x, const float* y,
                 const InterpolatedSpans& points) {
    multiversion<RunLoop>(triangle, count, x, y, points);
}

void TriangleLanes::interpolate(const float* x, const float* y, const InterpolatedSpans& points) {
    const float(*const numbers)[k_lanes] = numbers_;
    multiversion<LaneLoop>(numbers, size_, x, y, points);
    size_ = 0;
}

}  // namespace candela
