module;

#include "candela/multiversion.h"

#include <cstddef>
#include <cstdint>

module candela.fragments;

import :interpolation;

namespace candela {

namespace {

/// One fragment of one triangle. Vertex k is at (x, y, w)_k, homogeneous pixels.
struct Fragment {
    float b0, b1, b2;

    [[gnu::always_inline]] Fragment(float px, float py, float x0, float y0, float w0, float x1, float y1,
                                    float w1, float x2, float y2, float w2) {
        // Vertices relative to the fragment; areas of the three sub-triangles, with the perspective already
        // undone by w.
        x0 -= px * w0, y0 -= py * w0;
        x1 -= px * w1, y1 -= py * w1;
        x2 -= px * w2, y2 -= py * w2;
        b0 = x1 * y2 - x2 * y1;
        b1 = x2 * y0 - x0 * y2;
        b2 = x0 * y1 - x1 * y0;
        // Stays on the triangle even where its fixed-point image reaches slightly beyond it.
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

    [[gnu::always_inline]] void store(const InterpolatedSpans& out, std::size_t i) const {
        out.barycentric.x[i] = b0;
        out.barycentric.y[i] = b1;
        out.barycentric.z[i] = b2;
    }
    [[gnu::always_inline]] float blend(float at_0, float at_1, float at_2) const {
        return b0 * at_0 + b1 * at_1 + b2 * at_2;
    }
    [[gnu::always_inline]] float blend(const Columns& at_0, const Columns& at_1, const Columns& at_2,
                                       std::size_t column, std::size_t lane) const {
        return blend(at_0.real[column][lane], at_1.real[column][lane], at_2.real[column][lane]);
    }
};

template <Interpolated what>
struct RunLoop {
    CANDELA_BATCH_LOOP static void run(TriangleAttributes t, std::size_t count, const float* px,
                                       const float* py, InterpolatedSpans out) {
        const ProjectedVertex s0 = t.projected[0], s1 = t.projected[1], s2 = t.projected[2];
        const Vec3 p0 = t.corner[0].position, p1 = t.corner[1].position, p2 = t.corner[2].position;
        const Vec3 n0 = t.corner[0].normal, n1 = t.corner[1].normal, n2 = t.corner[2].normal;
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) {
            const Fragment f(px[i], py[i], s0.x, s0.y, s0.w, s1.x, s1.y, s1.w, s2.x, s2.y, s2.w);
            if constexpr (what != Interpolated::position_and_normal) f.store(out, i);
            if constexpr (what == Interpolated::barycentric) continue;
            out.position.x[i] = f.blend(p0.x, p1.x, p2.x);
            out.position.y[i] = f.blend(p0.y, p1.y, p2.y);
            out.position.z[i] = f.blend(p0.z, p1.z, p2.z);
            out.vertex_normal.x[i] = f.blend(n0.x, n1.x, n2.x);
            out.vertex_normal.y[i] = f.blend(n0.y, n1.y, n2.y);
            out.vertex_normal.z[i] = f.blend(n0.z, n1.z, n2.z);
            if constexpr (what != Interpolated::all) continue;
            out.face_normal.x[i] = t.face_normal.x;
            out.face_normal.y[i] = t.face_normal.y;
            out.face_normal.z[i] = t.face_normal.z;
        }
    }
};

/// What a vector of fragments reads of one vertex each.
struct CornerColumns {
    Columns projected, position, normal;

    template <Interpolated what>
    [[gnu::always_inline]] void fetch(const IndexedMesh& mesh, const std::uint32_t (&vertex)[k_lanes]) {
        projected.gather([&](std::size_t i) { return &mesh.projected[vertex[i]].x; });
        if constexpr (what == Interpolated::barycentric) return;
        position.gather([&](std::size_t i) { return &mesh.vertices[vertex[i]].position.x; });
        normal.gather([&](std::size_t i) { return &mesh.vertices[vertex[i]].normal.x; });
    }
};

/// Each fragment fetches the vertices of its triangle.
template <Interpolated what>
struct FetchLoop {
    CANDELA_BATCH_LOOP static void run(IndexedMesh m, std::size_t count, const std::uint32_t* triangle,
                                       const float* px, const float* py, InterpolatedSpans out) {
        CornerColumns c0, c1, c2;
        for (std::size_t first = 0; first < count; first += k_lanes) {
            std::uint32_t vertex[3][k_lanes];
// As scalars, one by one: they become addresses, not vectors.
#pragma clang loop unroll(disable) vectorize(disable)
            for (std::size_t lane = 0; lane < k_lanes; ++lane) {
                const std::uint32_t* const indices = m.indices + 3 * std::size_t{triangle[first + lane]};
                vertex[0][lane] = indices[0];
                vertex[1][lane] = indices[1];
                vertex[2][lane] = indices[2];
            }
            c0.template fetch<what>(m, vertex[0]);
            c1.template fetch<what>(m, vertex[1]);
            c2.template fetch<what>(m, vertex[2]);
            CANDELA_VECTORIZE_SIXTEEN
            for (std::size_t lane = 0; lane < k_lanes; ++lane) {
                const std::size_t i = first + lane;
                const Fragment f(px[i], py[i], c0.projected.real[0][lane], c0.projected.real[1][lane],
                                 c0.projected.real[2][lane], c1.projected.real[0][lane],
                                 c1.projected.real[1][lane], c1.projected.real[2][lane],
                                 c2.projected.real[0][lane], c2.projected.real[1][lane],
                                 c2.projected.real[2][lane]);
                if constexpr (what != Interpolated::position_and_normal) f.store(out, i);
                if constexpr (what == Interpolated::barycentric) continue;
                out.position.x[i] = f.blend(c0.position, c1.position, c2.position, 0, lane);
                out.position.y[i] = f.blend(c0.position, c1.position, c2.position, 1, lane);
                out.position.z[i] = f.blend(c0.position, c1.position, c2.position, 2, lane);
                out.vertex_normal.x[i] = f.blend(c0.normal, c1.normal, c2.normal, 0, lane);
                out.vertex_normal.y[i] = f.blend(c0.normal, c1.normal, c2.normal, 1, lane);
                out.vertex_normal.z[i] = f.blend(c0.normal, c1.normal, c2.normal, 2, lane);
                if constexpr (what != Interpolated::all) continue;
                const std::uint32_t t = triangle[i];
                out.face_normal.x[i] = m.face_normal.x[t];
                out.face_normal.y[i] = m.face_normal.y[t];
                out.face_normal.z[i] = m.face_normal.z[t];
            }
        }
    }
};

}  // namespace

void interpolate(Interpolated what, const TriangleAttributes& triangle, std::size_t count, const float* x,
                 const float* y, const InterpolatedSpans& points) {
    const std::size_t filled = whole_vectors(count);
    switch (what) {
        case Interpolated::barycentric:
            return multiversion<RunLoop<Interpolated::barycentric>>(triangle, filled, x, y, points);
        case Interpolated::position_and_normal:
            return multiversion<RunLoop<Interpolated::position_and_normal>>(triangle, filled, x, y, points);
        case Interpolated::all:
            return multiversion<RunLoop<Interpolated::all>>(triangle, filled, x, y, points);
    }
}

void interpolate_each(Interpolated what, const IndexedMesh& mesh, std::size_t count,
                      const std::uint32_t* triangle, const float* x, const float* y,
                      const InterpolatedSpans& points) {
    const std::size_t filled = whole_vectors(count);
    switch (what) {
        case Interpolated::barycentric:
            return multiversion<FetchLoop<Interpolated::barycentric>>(mesh, filled, triangle, x, y, points);
        case Interpolated::position_and_normal:
            return multiversion<FetchLoop<Interpolated::position_and_normal>>(mesh, filled, triangle, x, y,
                                                                              points);
        case Interpolated::all:
            return multiversion<FetchLoop<Interpolated::all>>(mesh, filled, triangle, x, y, points);
    }
}

}  // namespace candela
