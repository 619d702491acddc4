module;

#include "candela/kernel/simd_dispatch.h"

#include <cstddef>
#include <cstdint>

module candela.raster;

import :interpolation;

namespace candela {

namespace {

/// One fragment of one triangle. Vertex k is at (x, y, w)_k, homogeneous pixels relative to the fragment.
struct Fragment {
    float x0, y0, w0, x1, y1, w1, x2, y2, w2;
    float b0, b1, b2;
    float scale;  // one over twice the area, with its sign

    [[gnu::always_inline]] Fragment(float px, float py, float at_x0, float at_y0, float at_w0, float at_x1,
                                    float at_y1, float at_w1, float at_x2, float at_y2, float at_w2)
        : x0(at_x0 - px * at_w0),
          y0(at_y0 - py * at_w0),
          w0(at_w0),
          x1(at_x1 - px * at_w1),
          y1(at_y1 - py * at_w1),
          w1(at_w1),
          x2(at_x2 - px * at_w2),
          y2(at_y2 - py * at_w2),
          w2(at_w2) {
        // Areas of the three sub-triangles, with perspective already removed by w.
        b0 = x1 * y2 - x2 * y1;
        b1 = x2 * y0 - x0 * y2;
        b2 = x0 * y1 - x1 * y0;
        // Stays on the triangle even if its fixed-point image extends slightly beyond it.
        const float sign = b0 + b1 + b2 < 0.0f ? -1.0f : 1.0f;
        b0 = b0 * sign > 0.0f ? b0 * sign : 0.0f;
        b1 = b1 * sign > 0.0f ? b1 * sign : 0.0f;
        b2 = b2 * sign > 0.0f ? b2 * sign : 0.0f;
        const float sum = b0 + b1 + b2;
        scale = 1.0f / (sum > 0.0f ? sum : 1.0f);
        b0 = sum > 0.0f ? b0 * scale : 1.0f;
        b1 = b1 * scale;
        b2 = b2 * scale;
        scale *= sign;
    }

    [[gnu::always_inline]] void store(const InterpolatedSpans& out, std::size_t i) const {
        out.barycentric.x[i] = b0;
        out.barycentric.y[i] = b1;
        out.barycentric.z[i] = b2;
    }
    [[gnu::always_inline]] float blend(float at_0, float at_1, float at_2) const {
        return b0 * at_0 + b1 * at_1 + b2 * at_2;
    }

    /// Texture coordinates, and how they change over the picture. Barycentric coordinates are b_k = N_k / S,
    /// where the N_k = A_k + B_k x + C_k y and their sum S are linear in the pixel's position (Blinn 1992),
    /// so that du/dx = sum of B_k (u_k - u) / S, and the others accordingly.
    [[gnu::always_inline]] void store_uv(const InterpolatedSpans& out, std::size_t i, float u0, float u1,
                                         float u2, float v0, float v1, float v2) const {
        const float u = blend(u0, u1, u2), v = blend(v0, v1, v2);
        out.uv.x[i] = u;
        out.uv.y[i] = v;
        u0 -= u, u1 -= u, u2 -= u;
        v0 -= v, v1 -= v, v2 -= v;
        const float per_x0 = w2 * y1 - w1 * y2, per_x1 = w0 * y2 - w2 * y0, per_x2 = w1 * y0 - w0 * y1;
        const float per_y0 = w1 * x2 - w2 * x1, per_y1 = w2 * x0 - w0 * x2, per_y2 = w0 * x1 - w1 * x0;
        out.uv_per_x.x[i] = scale * (per_x0 * u0 + per_x1 * u1 + per_x2 * u2);
        out.uv_per_x.y[i] = scale * (per_x0 * v0 + per_x1 * v1 + per_x2 * v2);
        out.uv_per_y.x[i] = scale * (per_y0 * u0 + per_y1 * u1 + per_y2 * u2);
        out.uv_per_y.y[i] = scale * (per_y0 * v0 + per_y1 * v1 + per_y2 * v2);
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
        constexpr std::size_t k_four = 4 * k_lanes;
        const std::size_t whole = count / k_four * k_four;
        CANDELA_VECTORIZE_FOUR
        for (std::size_t i = 0; i < whole; ++i) put(t, px, py, out, i);
        for (std::size_t first = whole; first < count; first += k_lanes) {
            CANDELA_VECTORIZE_SIXTEEN
            for (std::size_t lane = 0; lane < k_lanes; ++lane) put(t, px, py, out, first + lane);
        }
    }

  private:
    CANDELA_BATCH_LOOP static void put(const TriangleAttributes& t, const float* px, const float* py,
                                       const InterpolatedSpans& out, std::size_t i) {
        const ProjectedVertex s0 = t.projected[0], s1 = t.projected[1], s2 = t.projected[2];
        const Vec3 p0 = t.corner[0].position, p1 = t.corner[1].position, p2 = t.corner[2].position;
        const Vec3 n0 = t.corner[0].normal, n1 = t.corner[1].normal, n2 = t.corner[2].normal;
        const Fragment f(px[i], py[i], s0.x, s0.y, s0.w, s1.x, s1.y, s1.w, s2.x, s2.y, s2.w);
        if constexpr (has_faces(what) || what == Interpolated::barycentric) f.store(out, i);
        if constexpr (has_uv(what)) f.store_uv(out, i, t.u[0], t.u[1], t.u[2], t.v[0], t.v[1], t.v[2]);
        if constexpr (!has_points(what)) return;
        out.position.x[i] = f.blend(p0.x, p1.x, p2.x);
        out.position.y[i] = f.blend(p0.y, p1.y, p2.y);
        out.position.z[i] = f.blend(p0.z, p1.z, p2.z);
        out.vertex_normal.x[i] = f.blend(n0.x, n1.x, n2.x);
        out.vertex_normal.y[i] = f.blend(n0.y, n1.y, n2.y);
        out.vertex_normal.z[i] = f.blend(n0.z, n1.z, n2.z);
        if constexpr (!has_faces(what)) return;
        out.face_normal.x[i] = t.face_normal.x;
        out.face_normal.y[i] = t.face_normal.y;
        out.face_normal.z[i] = t.face_normal.z;
    }
};

/// The attributes that a vector of fragments reads of one vertex each.
struct CornerColumns {
    Columns projected, position, normal;

    template <Interpolated what>
    [[gnu::always_inline]] void fetch(const IndexedMesh& mesh, const std::uint32_t (&vertex)[k_lanes]) {
        projected.gather([&](std::size_t i) { return &mesh.projected[vertex[i]].x; });
        if constexpr (!has_points(what)) return;
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
            alignas(64) float u[3][k_lanes], v[3][k_lanes];
// As scalars, one by one: they become addresses, not vectors.
#pragma clang loop unroll(disable) vectorize(disable)
            for (std::size_t lane = 0; lane < k_lanes; ++lane) {
                const std::uint32_t* const indices = m.indices + 3 * std::size_t{triangle[first + lane]};
                vertex[0][lane] = indices[0];
                vertex[1][lane] = indices[1];
                vertex[2][lane] = indices[2];
                if constexpr (!has_uv(what)) continue;
                for (std::size_t k = 0; k < 3; ++k) {
                    u[k][lane] = m.uv.x[indices[k]];
                    v[k][lane] = m.uv.y[indices[k]];
                }
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
                if constexpr (has_faces(what) || what == Interpolated::barycentric) f.store(out, i);
                if constexpr (has_uv(what)) {
                    f.store_uv(out, i, u[0][lane], u[1][lane], u[2][lane], v[0][lane], v[1][lane],
                               v[2][lane]);
                }
                if constexpr (!has_points(what)) continue;
                out.position.x[i] = f.blend(c0.position, c1.position, c2.position, 0, lane);
                out.position.y[i] = f.blend(c0.position, c1.position, c2.position, 1, lane);
                out.position.z[i] = f.blend(c0.position, c1.position, c2.position, 2, lane);
                out.vertex_normal.x[i] = f.blend(c0.normal, c1.normal, c2.normal, 0, lane);
                out.vertex_normal.y[i] = f.blend(c0.normal, c1.normal, c2.normal, 1, lane);
                out.vertex_normal.z[i] = f.blend(c0.normal, c1.normal, c2.normal, 2, lane);
                if constexpr (!has_faces(what)) continue;
                const std::uint32_t t = triangle[i];
                out.face_normal.x[i] = m.face_normal.x[t];
                out.face_normal.y[i] = m.face_normal.y[t];
                out.face_normal.z[i] = m.face_normal.z[t];
            }
        }
    }
};

/// Calls `run.operator()<what>()`, for a `what` known only at run time.
template <class Run>
void dispatch(Interpolated what, Run run) {
    switch (what) {
        case Interpolated::barycentric:
            return run.template operator()<Interpolated::barycentric>();
        case Interpolated::position_and_normal:
            return run.template operator()<Interpolated::position_and_normal>();
        case Interpolated::position_and_normal_and_uv:
            return run.template operator()<Interpolated::position_and_normal_and_uv>();
        case Interpolated::all_but_uv:
            return run.template operator()<Interpolated::all_but_uv>();
        case Interpolated::all:
            return run.template operator()<Interpolated::all>();
        case Interpolated::uv:
            return run.template operator()<Interpolated::uv>();
    }
}

}  // namespace

void interpolate(Interpolated what, const TriangleAttributes& triangle, std::size_t count, const float* x,
                 const float* y, const InterpolatedSpans& points) {
    dispatch(what, [&]<Interpolated known>() {
        multiversion<RunLoop<known>>(triangle, whole_vectors(count), x, y, points);
    });
}

void interpolate_each(Interpolated what, const IndexedMesh& mesh, std::size_t count,
                      const std::uint32_t* triangle, const float* x, const float* y,
                      const InterpolatedSpans& points) {
    dispatch(what, [&]<Interpolated known>() {
        multiversion<FetchLoop<known>>(mesh, whole_vectors(count), triangle, x, y, points);
    });
}

}  // namespace candela
