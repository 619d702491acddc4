// Makes a shading model from one kernel function:
//
//     vec3 x_normal(ShadingPoint p)                  the unit normal at a point, or
//     vec3 x_normal(XShading shading, ShadingPoint p)    with parameters
//
// For vertex normals that are a weighted sum of the face normals, also:
//
//     float x_corner_weight(FaceCorner c)                 the weight of a face at one of its corners, or
//     float x_corner_weight(XShading shading, FaceCorner c)
//
// A model that reads the vertices of its triangle, and their normals, takes the triangle as the last
// argument:
//
//     vec3 x_normal(ShadingPoint p, Triangle t)          or
//     vec3 x_normal(XShading shading, ShadingPoint p, Triangle t)
//
// The last argument of KernelShading says what the model reads of a ShadingPoint; the rest is zero. For a
// model in a .kernel file, that is found in its text.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "candela/kernel/simd_dispatch.h"
#include "candela/plugin.h"
#include "candela/shading_model.h"

namespace candela::sdk {

/// Whether a kernel's x_normal takes a Triangle. If not, the triangle is not filled.
template <class Params, auto normal>
inline constexpr bool takes_triangle =
    std::is_invocable_v<decltype(normal), Params, kernel::ShadingPoint, kernel::Triangle> ||
    std::is_invocable_v<decltype(normal), kernel::ShadingPoint, kernel::Triangle>;

template <class Params, auto normal, ShadingNeeds needs>
struct NormalLoop {
    CANDELA_BATCH_LOOP static void run(Params params, ShadingPointBatch points, Vec3Span normals) {
        const std::size_t count = points.count;
        const TriangleBatch corners = needs.triangle ? *points.triangle : TriangleBatch{};
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) {
            kernel::ShadingPoint p;
            p.face_normal = vec3(0.0f);
            p.vertex_normal = vec3(0.0f);
            p.barycentric = vec3(0.0f);
            if constexpr (needs.face_normal) p.face_normal = load(points.face_normal, i);
            if constexpr (needs.vertex_normal) p.vertex_normal = load(points.vertex_normal, i);
            if constexpr (needs.barycentric) p.barycentric = load(points.barycentric, i);
            p.uv = vec2(0.0f);
            p.dpdu = vec3(0.0f);
            p.dpdv = vec3(0.0f);
            if constexpr (needs.uv) p.uv = vec2(points.uv.x[i], points.uv.y[i]);
            if constexpr (needs.derivatives) {
                p.dpdu = load(points.dpdu, i);
                p.dpdv = load(points.dpdv, i);
            }
            if constexpr (needs.triangle) {
                kernel::Triangle t;
                t.p0 = load(corners.position[0], i);
                t.p1 = load(corners.position[1], i);
                t.p2 = load(corners.position[2], i);
                t.n0 = load(corners.normal[0], i);
                t.n1 = load(corners.normal[1], i);
                t.n2 = load(corners.normal[2], i);
                store(normals, i, call<normal>(params, p, t));
            } else {
                store(normals, i, call<normal>(params, p));
            }
        }
    }
};

template <class Params, ShadingRate rate, auto normal, ShadingNeeds needs_ = ShadingNeeds{}>
class KernelShading : public ShadingModel {
    static constexpr bool k_takes_triangle = takes_triangle<Params, normal>;
    static_assert(!k_takes_triangle || rate != ShadingRate::vertex,
                  "a model that is lit per vertex has no Triangle: a vertex belongs to several");
    static_assert(k_takes_triangle || !needs_.triangle,
                  "a model that needs its triangle takes a Triangle after the ShadingPoint");

  public:
    static constexpr ShadingNeeds k_needs = [] {
        ShadingNeeds needs = needs_;
        needs.triangle = k_takes_triangle;
        return needs;
    }();
    static constexpr KernelFunction k_kernel_functions[] = {kernel_function<Params, normal>("normal")};

    explicit KernelShading(const Params& params) : params_(params) {}
    ShadingRate shading_rate() const noexcept override { return rate; }
    void normals(const ShadingPointBatch& points, const Vec3Span& normals) const override {
        multiversion<NormalLoop<Params, normal, k_needs>>(params_, points, normals);
    }

  protected:
    const Params& params() const noexcept { return params_; }

  private:
    [[no_unique_address]] Params params_;
};

template <class Params, auto weight>
struct CornerWeightLoop {
    CANDELA_BATCH_LOOP static void run(Params params, std::size_t count, ConstVec3Span to_next,
                                       ConstVec3Span to_previous, float* weights) {
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) {
            kernel::FaceCorner c;
            c.to_next = load(to_next, i);
            c.to_previous = load(to_previous, i);
            weights[i] = call<weight>(params, c);
        }
    }
};

/// A power of two that scales the mesh to about one unit, so that products of its edges stay within a float's
/// range; being exact, it changes nothing else.
inline float unit_scale(const MeshView& mesh) {
    float largest = 0;
    for (const float* const axis : {mesh.position.x, mesh.position.y, mesh.position.z}) {
        const auto [low, high] = std::minmax_element(axis, axis + mesh.vertex_count);
        if (low != high) largest = std::max(largest, *high - *low);
    }
    const bool is_usual = largest > 1e-30f && largest < 1e30f;
    return is_usual ? std::ldexp(1.0f, -std::ilogb(largest)) : 1.0f;
}

/// Sums the normals of the faces that share a vertex, each weighted by `weight` of the face's corner there.
template <class Params, auto weight>
class WeightedNormals {
  public:
    WeightedNormals(const Params& params, const MeshView& mesh)
        : params_(params), mesh_(mesh), scale_(unit_scale(mesh)), sum_(mesh.group_count) {}

    /// Overwrites `normals`, except where all weights are zero or out of range.
    void write(const Vec3Span& normals) {
        const std::size_t indices = mesh_.indices.size();
        for (std::size_t first = 0; first < indices; first += k_batch)
            add(first, std::min(k_batch, indices - first));
        for (std::size_t group = 0; group < sum_.size(); ++group) {
            const auto& [x, y, z] = sum_[group];
            const double length = std::sqrt(x * x + y * y + z * z);
            if (!(length > 0) || !std::isfinite(length)) continue;
            normals.set(group, {static_cast<float>(x / length), static_cast<float>(y / length),
                                static_cast<float>(z / length)});
        }
    }

  private:
    static constexpr std::size_t k_batch = 192;  // corners of whole triangles

    struct Edges {
        std::array<float, k_batch> x, y, z;
        Vec3Span span() { return {x.data(), y.data(), z.data()}; }
    };

    void add(std::size_t first, std::size_t count) {
        const auto vertex = [&](std::size_t corner) { return mesh_.position[mesh_.indices[corner]]; };
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t corner = first + i;
            const std::size_t triangle = corner - i % 3;
            const Vec3 here = vertex(corner);
            to_next_.span().set(i, scale_ * (vertex(triangle + (i + 1) % 3) - here));
            to_previous_.span().set(i, scale_ * (vertex(triangle + (i + 2) % 3) - here));
        }
        multiversion<CornerWeightLoop<Params, weight>>(params_, count, ConstVec3Span(to_next_.span()),
                                                       ConstVec3Span(to_previous_.span()), weights_.data());
        for (std::size_t i = 0; i < count; ++i) {
            const Vec3 normal = mesh_.face_normal[(first + i) / 3];
            auto& sum = sum_[mesh_.smooth_group[mesh_.indices[first + i]]];
            sum[0] += static_cast<double>(weights_[i]) * normal.x;
            sum[1] += static_cast<double>(weights_[i]) * normal.y;
            sum[2] += static_cast<double>(weights_[i]) * normal.z;
        }
    }

    Params params_;
    const MeshView& mesh_;
    float scale_;
    std::vector<std::array<double, 3>> sum_;
    Edges to_next_, to_previous_;
    std::array<float, k_batch> weights_;
};

/// Weighted vertex normals. If no face has a weight, the plain sum is used; authored normals take precedence.
template <class Params, ShadingRate rate, auto normal, auto weight, ShadingNeeds needs_ = ShadingNeeds{}>
class WeightedShading : public KernelShading<Params, rate, normal, needs_> {
    using Base = KernelShading<Params, rate, normal, needs_>;

  public:
    static constexpr KernelFunction k_kernel_functions[] = {kernel_function<Params, normal>("normal"),
                                                            kernel_function<Params, weight>("corner_weight")};

    using Base::Base;
    void vertex_normals(const MeshView& mesh, const Vec3Span& normals) const override {
        ShadingModel::vertex_normals(mesh, normals);
        if (!mesh.authored_normal) WeightedNormals<Params, weight>(this->params(), mesh).write(normals);
    }
};

}  // namespace candela::sdk
