// Perspective-correct interpolation between the corners of triangles.
module;

#include "candela/multiversion.h"

#include <cstddef>
#include <cstdint>

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
            out.face_normal.x[i] = t.face_normal.x;
            out.face_normal.y[i] = t.face_normal.y;
            out.face_normal.z[i] = t.face_normal.z;
        }
    }
};

/// Each fragment fetches the corners of its triangle.
struct FetchLoop {
    CANDELA_BATCH_LOOP static void run(IndexedMesh m, std::size_t count, const std::int32_t* triangle,
                                       const float* px, const float* py, InterpolatedSpans out) {
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) {
            const std::int32_t t = triangle[i];
            const std::int32_t corner = 3 * t;
            const std::int32_t v0 = m.corners[corner], v1 = m.corners[corner + 1], v2 = m.corners[corner + 2];
            const float w0 = m.perspective ? m.w[v0] : 1.0f;
            const float w1 = m.perspective ? m.w[v1] : 1.0f;
            const float w2 = m.perspective ? m.w[v2] : 1.0f;
            const Fragment f(px[i], py[i], m.x[v0], m.y[v0], w0, m.x[v1], m.y[v1], w1, m.x[v2], m.y[v2], w2);
            out.barycentric.x[i] = f.b0;
            out.barycentric.y[i] = f.b1;
            out.barycentric.z[i] = f.b2;
            out.position.x[i] = f.blend(m.position.x[v0], m.position.x[v1], m.position.x[v2]);
            out.position.y[i] = f.blend(m.position.y[v0], m.position.y[v1], m.position.y[v2]);
            out.position.z[i] = f.blend(m.position.z[v0], m.position.z[v1], m.position.z[v2]);
            out.vertex_normal.x[i] =
                f.blend(m.vertex_normal.x[v0], m.vertex_normal.x[v1], m.vertex_normal.x[v2]);
            out.vertex_normal.y[i] =
                f.blend(m.vertex_normal.y[v0], m.vertex_normal.y[v1], m.vertex_normal.y[v2]);
            out.vertex_normal.z[i] =
                f.blend(m.vertex_normal.z[v0], m.vertex_normal.z[v1], m.vertex_normal.z[v2]);
            out.face_normal.x[i] = m.face_normal.x[t];
            out.face_normal.y[i] = m.face_normal.y[t];
            out.face_normal.z[i] = m.face_normal.z[t];
        }
    }
};

}  // namespace

void interpolate(const TriangleAttributes& triangle, std::size_t count, const float* x, const float* y,
                 const InterpolatedSpans& points) {
    multiversion<RunLoop>(triangle, whole_vectors(count), x, y, points);
}

void interpolate_each(const IndexedMesh& mesh, std::size_t count, const std::int32_t* triangle,
                      const float* x, const float* y, const InterpolatedSpans& points) {
    multiversion<FetchLoop>(mesh, whole_vectors(count), triangle, x, y, points);
}

}  // namespace candela
