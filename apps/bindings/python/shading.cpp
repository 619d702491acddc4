// Shading models, called on arrays.
#include "arrays.h"
#include "instances.h"
#include "module.h"

import candela.api;

namespace candela::python {

namespace {

using Shading = ModelInstance<ShadingModel>;
using Corners = std::array<Vectors, 3>;
using CornerBuffers = std::array<BatchVectors, 3>;

struct Buffers {
    CornerBuffers positions, normals;
    BatchVectors weights, uv, dpdu, dpdv, face_normals, vertex_normals, results;
};

Vec3 face_normal_of(Vec3 a, Vec3 b, Vec3 c) { return normalized(cross(b - a, c - a)); }

TriangleBatch triangle_of(const Corners& positions, const Corners& normals, std::size_t first,
                          std::size_t count, CornerBuffers& position_buffers, CornerBuffers& normal_buffers) {
    TriangleBatch triangle;
    for (std::size_t corner = 0; corner < 3; ++corner) {
        triangle.position[corner] = positions[corner].read(first, count, position_buffers[corner]);
        triangle.normal[corner] = normals[corner].read(first, count, normal_buffers[corner]);
    }
    return triangle;
}

/// Interpolates the values at the points of a batch from their triangles.
void interpolate(const TriangleBatch& triangle, ConstVec3Span barycentric, std::size_t count,
                 Vec3Span face_normal, Vec3Span vertex_normal) {
    for (std::size_t i = 0; i < count; ++i) {
        face_normal.set(
            i, face_normal_of(triangle.position[0][i], triangle.position[1][i], triangle.position[2][i]));
        const Vec3 weights = barycentric[i];
        vertex_normal.set(i, weights.x * triangle.normal[0][i] + weights.y * triangle.normal[1][i] +
                                 weights.z * triangle.normal[2][i]);
    }
}

Floats normals_at(const Shading& model, const std::array<Floats, 3>& triangles,
                  const std::array<Floats, 3>& vertex_normals, const Floats& barycentrics,
                  const std::optional<Floats>& uv, const std::optional<Floats>& dpdu,
                  const std::optional<Floats>& dpdv, int threads) {
    const ShadingNeeds& needs = model.descriptor().shading_needs;
    if (needs.derivatives && !(dpdu && dpdv))
        throw Error(ErrorCategory::bad_request,
                    fmt::format("shading/{} reads partial derivatives (dpdu and dpdv), which are missing",
                                model.name()));
    if (needs.uv && !uv)
        throw Error(
            ErrorCategory::bad_request,
            fmt::format("shading/{} reads texture coordinates (uv), which are missing", model.name()));
    Corners positions, normals;
    for (std::size_t corner = 0; corner < 3; ++corner) {
        positions[corner] = Vectors(triangles[corner], "triangles");
        normals[corner] = Vectors(vertex_normals[corner], "vertex_normals");
    }
    const Vectors weights(barycentrics, "barycentrics"), coordinates(uv, "uv"), along_u(dpdu, "dpdu"),
        along_v(dpdv, "dpdv");
    require_same_count({&positions[0], &positions[1], &positions[2], &normals[0], &normals[1], &normals[2],
                        &weights, &coordinates, &along_u, &along_v});
    const bool is_at_vertices = model.instance().shading_rate() == ShadingRate::vertex;
    Results results(weights.count());
    {
        const py::gil_scoped_release unlocked;
        for_batches<Buffers>(
            weights.count(), threads, [&](Buffers& buffers, std::size_t first, std::size_t count) {
                auto& [position_buffers, normal_buffers, weight, coordinate, of_u, of_v, face, vertex,
                       result] = buffers;
                const TriangleBatch triangle =
                    triangle_of(positions, normals, first, count, position_buffers, normal_buffers);
                const ConstVec3Span barycentric = weights.read(first, count, weight);
                const ConstVec3Span at = coordinates.read(first, count, coordinate);
                if (barycentric.x != nullptr)  // always, which clang-tidy does not see
                    interpolate(triangle, barycentric, count, face.span(), vertex.span());
                model.guarded([&](const ShadingModel& instance) {
                    instance.normals({.count = count,
                                      .face_normal = face.span(),
                                      .vertex_normal = vertex.span(),
                                      .barycentric = barycentric,
                                      .uv = {at.x, at.y},
                                      .dpdu = along_u.read(first, count, of_u),
                                      .dpdv = along_v.read(first, count, of_v),
                                      .triangle = is_at_vertices ? nullptr : &triangle},
                                     result.span());
                });
                results.write(first, count, result.span());
            });
    }
    return results.take();
}

using Indices = py::array_t<std::uint32_t, py::array::c_style | py::array::forcecast>;

/// The normals of a mesh in which each vertex has a normal of its own.
Floats vertex_normals_of(const Shading& model, const Floats& vertices, const Indices& triangles) {
    const Vectors given(vertices, "positions");
    if (triangles.ndim() != 2 || triangles.shape(1) != 3)
        throw py::value_error("triangles must have the shape (N, 3)");
    const std::size_t count = given.count();
    const std::span indices(triangles.data(), static_cast<std::size_t>(triangles.size()));
    if (std::ranges::any_of(indices, [&](std::uint32_t index) { return index >= count; }))
        throw py::index_error(
            fmt::format("a triangle has a vertex index out of range; there are {} vertices", count));
    const std::size_t faces = indices.size() / 3;
    std::vector<float> numbers(6 * count + 3 * faces);
    const auto part = [&](std::size_t first, std::size_t size) {
        float* const x = numbers.data() + first;
        return Vec3Span{x, x + size, x + 2 * size};
    };
    const Vec3Span positions = part(0, count), normals = part(3 * count, count),
                   face_normals = part(6 * count, faces);
    std::vector<std::uint32_t> groups(count);
    for (std::size_t i = 0; i < count; ++i) {
        positions.set(i, given[i]);
        groups[i] = static_cast<std::uint32_t>(i);
    }
    for (std::size_t i = 0; i < faces; ++i)
        face_normals.set(
            i, face_normal_of(given[indices[3 * i]], given[indices[3 * i + 1]], given[indices[3 * i + 2]]));
    Results results(count);
    {
        const py::gil_scoped_release unlocked;
        model.guarded([&](const ShadingModel& instance) {
            instance.vertex_normals({.position = positions,
                                     .indices = indices,
                                     .face_normal = face_normals,
                                     .smooth_group = groups,
                                     .vertex_count = count,
                                     .group_count = count,
                                     .authored_normal = {}},
                                    normals);
        });
        results.write(0, count, normals);
    }
    return results.take();
}

const char* rate_of(const Shading& model) {
    switch (model.instance().shading_rate()) {
        case ShadingRate::face:
            return "face";
        case ShadingRate::vertex:
            return "vertex";
        default:
            return "fragment";
    }
}

}  // namespace

void add_shading(py::module_& module) {
    py::class_<Shading>(module, "Shading", "A shading model with values.")
        .def(py::init<RegistryPointer, std::string, const py::dict&, const std::string&>(),
             py::arg("registry"), py::arg("name"), py::arg("values"), py::arg("color_management"))
        .def_property_readonly("name", &Shading::name)
        .def_property_readonly("values", &Shading::values)
        .def_property_readonly("rate", &rate_of)
        .def("normals", &normals_at, py::arg("triangles"), py::arg("vertex_normals"), py::arg("barycentrics"),
             py::arg("uv"), py::arg("dpdu"), py::arg("dpdv"), py::arg("threads"))
        .def("vertex_normals", &vertex_normals_of, py::arg("positions"), py::arg("triangles"));
}

}  // namespace candela::python
