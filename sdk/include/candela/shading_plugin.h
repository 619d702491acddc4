// A shading model from one kernel function:
//
//     vec3 x_normal(ShadingPoint p)                  the unit normal at a point, or
//     vec3 x_normal(XShading shading, ShadingPoint p)    with parameters
#pragma once

#include "candela/multiversion.h"
#include "candela/plugin.h"

import candela.shading;

namespace candela::sdk {

template <class Params, auto normal, ShadingNeeds needs>
struct NormalLoop {
    CANDELA_BATCH_LOOP static void run(Params params, ShadingPointBatch points, Vec3Span normals) {
        const std::size_t count = points.count;
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) {
            kernel::ShadingPoint p;
            p.face_normal = kernel_vector(points.face_normal[i]);
            p.vertex_normal = kernel_vector(points.vertex_normal[i]);
            p.barycentric = kernel_vector(points.barycentric[i]);
            p.uv = vec2(0.0f);
            p.dpdu = vec3(0.0f);
            p.dpdv = vec3(0.0f);
            if constexpr (needs.uv) p.uv = vec2(points.uv.x[i], points.uv.y[i]);
            if constexpr (needs.derivatives) {
                p.dpdu = kernel_vector(points.dpdu[i]);
                p.dpdv = kernel_vector(points.dpdv[i]);
            }
            const vec3 n = call<normal>(params, p);
            normals.x[i] = n.x;
            normals.y[i] = n.y;
            normals.z[i] = n.z;
        }
    }
};

template <class Params, LightingRate rate, auto normal, ShadingNeeds needs_ = ShadingNeeds{}>
class KernelShading final : public ShadingModel {
  public:
    explicit KernelShading(const Params& params) : params_(params) {}
    LightingRate lighting_rate() const noexcept override { return rate; }
    ShadingNeeds needs() const noexcept override { return needs_; }
    void normals(const ShadingPointBatch& points, const Vec3Span& normals) const override {
        multiversion<NormalLoop<Params, normal, needs_>>(params_, points, normals);
    }

  private:
    [[no_unique_address]] Params params_;
};

}  // namespace candela::sdk

/// A plugin from the kernel function `prefix_normal`; `rate` is face, vertex or fragment.
#define CANDELA_SHADING_PLUGIN(prefix, rate, Params, fields, ...)                           \
    CANDELA_KERNEL_PLUGIN(shading,                                                          \
                          (candela::sdk::KernelShading<Params, candela::LightingRate::rate, \
                                                       &candela::kernel::prefix##_normal>), \
                          prefix, Params, fields, __VA_ARGS__)
