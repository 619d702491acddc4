// Makes shapes. A parametric surface comes from three kernel functions, with u and v from 0 to 1 and dpdu x
// dpdv pointing outwards:
//
//     vec3 x_position(XShape s, float u, float v)
//     vec3 x_dpdu(XShape s, float u, float v)
//     vec3 x_dpdv(XShape s, float u, float v)
//
//     CANDELA_PARAMETRIC_SHAPE_PLUGIN(x, XShape, k_topology, k_fields, {.title = …})
//
// Any other shape derives from candela::Shape, fills the arrays of a MeshSink, and ends with
//
//     CANDELA_PLUGIN(shape, MyShape, k_fields, {.title = …})
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "candela/kernel/simd_dispatch.h"
#include "candela/plugin.h"
#include "candela/shape.h"

namespace candela::sdk {

/// The density parameter that the shipped curved shapes share.
template <class P>
constexpr Field<P> segments(std::int32_t P::* member, std::int32_t default_value, const char* meaning) {
    return integer(member, "segments", default_value, meaning).range(3, 8192);
}

/// How the edges of a surface's parameter square are connected.
struct Topology {
    bool u_is_periodic = false;  // u = 0 and u = 1 are the same edge
    bool v_is_periodic = false;
    bool v_ends_in_poles = false;  // v = 0 and v = 1 are single points
    bool is_convex = false;        // closed, and convex for all parameters
};

template <class Params, auto position>
struct SurfaceRowLoop {
    CANDELA_BATCH_LOOP static void run(Params params, float v, float u_step, std::size_t count, Vec3Span p) {
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) {
            const float u = static_cast<float>(static_cast<std::int32_t>(i)) * u_step;
            store(p, i, call<position>(params, u, v));
        }
    }
};

template <class Params, auto dpdu, auto dpdv>
struct SurfaceDerivativesRowLoop {
    CANDELA_BATCH_LOOP static void run(Params params, float v, float u_step, std::size_t count, Vec3Span pu,
                                       Vec3Span pv) {
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) {
            const float u = static_cast<float>(static_cast<std::int32_t>(i)) * u_step;
            store(pu, i, call<dpdu>(params, u, v));
            store(pv, i, call<dpdv>(params, u, v));
        }
    }
};

/// The triangles of a grid of `columns` x `rows` quadrilaterals over the parameter square.
template <class Params, auto position, auto dpdu, auto dpdv>
void tessellate_surface(const Params& params, Topology topology, std::size_t columns, std::size_t rows,
                        const MeshRequest& request, MeshSink& sink) {
    const std::size_t width = columns + 1;
    const bool closed = topology.u_is_periodic && (topology.v_is_periodic || topology.v_ends_in_poles);
    const std::size_t poles = topology.v_ends_in_poles ? 2 : 0;
    const MeshSpans mesh = sink.allocate({.vertices = width * (rows + 1),
                                          .triangles = columns * (2 * rows - poles),
                                          .has_uv = request.uv,
                                          .has_derivatives = request.derivatives,
                                          .has_smooth_groups = true,
                                          .closedness = topology.is_convex ? Closedness::convex
                                                        : closed           ? Closedness::closed
                                                                           : Closedness::open});

    for (std::size_t row = 0; row <= rows; ++row) {
        const std::size_t first = row * width;
        const float v = static_cast<float>(row) / static_cast<float>(rows);
        const float u_step = 1.0f / static_cast<float>(columns);
        multiversion<SurfaceRowLoop<Params, position>>(params, v, u_step, width, mesh.position.from(first));
        if (request.uv) {
            for (std::size_t column = 0; column <= columns; ++column) {
                mesh.uv.x[first + column] = static_cast<float>(column) * u_step;
                mesh.uv.y[first + column] = v;
            }
        }
        if (request.derivatives) {
            multiversion<SurfaceDerivativesRowLoop<Params, dpdu, dpdv>>(
                params, v, u_step, width, mesh.dpdu.from(first), mesh.dpdv.from(first));
        }
    }

    // Coinciding vertices get exactly one position, and one normal.
    const auto same = [&](std::size_t vertex, std::size_t as) {
        mesh.position.set(vertex, mesh.position[as]);
        mesh.smooth_group[vertex] = mesh.smooth_group[as];
    };
    for (std::size_t row = 0; row <= rows; ++row) {
        const bool is_pole = topology.v_ends_in_poles && (row == 0 || row == rows);
        for (std::size_t column = 0; column <= columns; ++column) {
            const std::size_t vertex = row * width + column;
            mesh.smooth_group[vertex] = static_cast<std::uint32_t>(vertex);
            if (topology.v_is_periodic && row == rows) {
                same(vertex, column);
            } else if (is_pole && column > 0) {
                same(vertex, row * width);
            } else if (topology.u_is_periodic && column == columns) {
                same(vertex, row * width);
            }
        }
    }

    std::size_t corner = 0;
    const auto triangle = [&](std::size_t a, std::size_t b, std::size_t c) {
        for (const std::size_t vertex : {a, b, c})
            mesh.indices[corner++] = static_cast<std::uint32_t>(vertex);
    };
    for (std::size_t row = 0; row < rows; ++row) {
        for (std::size_t column = 0; column < columns; ++column) {
            const std::size_t a = row * width + column;
            const std::size_t b = a + 1;
            const std::size_t c = b + width;
            const std::size_t d = a + width;
            const bool starts_in_pole = topology.v_ends_in_poles && row == 0;
            const bool ends_in_pole = topology.v_ends_in_poles && row + 1 == rows;
            if (!starts_in_pole) triangle(a, b, ends_in_pole ? d : c);
            if (!ends_in_pole) triangle(starts_in_pole ? b : a, c, d);
        }
    }
}

/// A shape whose parameters have a member `segments`: the number of faces along u. There are half as many
/// along v.
template <class Params, auto position, auto dpdu, auto dpdv, Topology topology>
class ParametricShape : public Shape {
  public:
    static constexpr KernelFunction k_kernel_functions[] = {kernel_function<Params, position>("position"),
                                                            kernel_function<Params, dpdu>("dpdu"),
                                                            kernel_function<Params, dpdv>("dpdv")};

    explicit ParametricShape(const Params& params) : params_(params) {}

    void tessellate(const MeshRequest& request, MeshSink& sink) const override {
        const auto columns = static_cast<std::size_t>(params_.segments);
        const std::size_t fewest_rows = topology.v_is_periodic ? 3 : 2;
        tessellate_surface<Params, position, dpdu, dpdv>(params_, topology, columns,
                                                         std::max(columns / 2, fewest_rows), request, sink);
    }

  private:
    Params params_;
};

/// Assigns vertices at exactly one position to one smooth group.
inline void weld_by_position(ConstVec3Span position, std::size_t count,
                             std::span<std::uint32_t> smooth_group) {
    std::ranges::copy(welded(position, count), smooth_group.begin());
}

}  // namespace candela::sdk

/// A plugin from the kernel functions `prefix_position`, `prefix_dpdu` and `prefix_dpdv`; `Params` is their
/// first argument and has a member `segments`; `topology` is a constant of type candela::sdk::Topology.
#define CANDELA_PARAMETRIC_SHAPE_PLUGIN(prefix, Params, topology, fields, ...)                        \
    CANDELA_KERNEL_PLUGIN(shape,                                                                      \
                          (candela::sdk::ParametricShape<Params, &candela::kernel::prefix##_position, \
                                                         &candela::kernel::prefix##_dpdu,             \
                                                         &candela::kernel::prefix##_dpdv, topology>), \
                          prefix, Params, fields, __VA_ARGS__)
