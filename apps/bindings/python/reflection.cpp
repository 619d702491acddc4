// Reflection models, called on arrays.
#include "arrays.h"
#include "instances.h"
#include "module.h"

import candela.api;

namespace candela::python {

namespace {

using Reflection = ModelInstance<ReflectionModel>;

/// The surface of each point, as arrays.
struct Surfaces {
    Vectors normals, to_observer, color, tangents, positions, uv;

    /// The layout for results: that of the normals or, if there is one normal for all points, of the
    /// directions.
    Layout layout() const noexcept { return (normals.is_uniform() ? to_observer : normals).layout(); }
};

/// The points of a batch, with their channels apart.
struct SurfaceBuffers {
    BatchVectors normals, to_observer, color, tangents, positions, uv;
};

struct Buffers {
    SurfaceBuffers surfaces;
    BatchVectors to_light, incident, ambient, diffuse, specular;
};

SurfaceBatch batch_of(const Surfaces& surfaces, std::size_t first, std::size_t count,
                      SurfaceBuffers& buffers) {
    const auto uv = surfaces.uv.read(first, count, buffers.uv);
    return {.count = count,
            .normal = surfaces.normals.read(first, count, buffers.normals),
            .to_observer = surfaces.to_observer.read(first, count, buffers.to_observer),
            .tangent = surfaces.tangents.read(first, count, buffers.tangents),
            .color = {},
            .position = surfaces.positions.read(first, count, buffers.positions),
            .uv = {uv.x, uv.y},
            .point_color = surfaces.color.read(first, count, buffers.color)};
}

Surfaces surfaces_from(const Reflection& model, const Floats& normals, const Floats& to_observer,
                       const Floats& color, const std::optional<Floats>& tangents, const Floats& positions,
                       const std::optional<Floats>& uv) {
    const auto require = [&](bool is_read, bool is_given, const char* what) {
        if (is_read && !is_given)
            throw Error(ErrorCategory::bad_request,
                        fmt::format("reflection/{} reads {}, which are missing", model.name(), what));
    };
    const SurfaceNeeds& needs = model.descriptor().surface_needs;
    require(needs.tangent, tangents.has_value(), "tangents");
    require(needs.uv, uv.has_value(), "texture coordinates (uv)");
    return {.normals = Vectors(normals, "normals"),
            .to_observer = Vectors(to_observer, "to_observer"),
            .color = Vectors(color, "color"),
            .tangents = Vectors(tangents, "tangents"),
            .positions = Vectors(positions, "positions"),
            .uv = Vectors(uv, "uv")};
}

/// Calls `write(first, count, diffuse, specular)` with the reflected light of each batch.
template <class Write>
void reflect(const Reflection& model, const Surfaces& surfaces, const Vectors& to_light, const Vectors& light,
             int threads, const Write& write) {
    require_same_count({&surfaces.normals, &surfaces.to_observer, &surfaces.color, &surfaces.tangents,
                        &surfaces.positions, &surfaces.uv, &to_light, &light});
    const py::gil_scoped_release unlocked;
    for_batches<Buffers>(
        surfaces.normals.count(), threads, [&](Buffers& buffers, std::size_t first, std::size_t count) {
            auto& [surface_buffers, to_light_buffer, light_buffer, ambient, diffuse, specular] = buffers;
            diffuse.clear();
            specular.clear();
            const ConstVec3Span incident = light.read(first, count, light_buffer);
            model.guarded([&](const ReflectionModel& instance) {
                instance.reflect(
                    batch_of(surfaces, first, count, surface_buffers),
                    {.to_light = to_light.read(first, count, to_light_buffer),
                     .diffuse = incident,
                     .specular = incident},
                    {.ambient = ambient.span(), .diffuse = diffuse.span(), .specular = specular.span()});
            });
            write(first, count, diffuse.span(), specular.span());
        });
}

Floats evaluate(const Reflection& model, const Floats& normals, const Floats& to_observer,
                const Floats& to_light, const Floats& color, const Floats& light,
                const std::optional<Floats>& tangents, const Floats& positions,
                const std::optional<Floats>& uv, int threads) {
    const Surfaces surfaces = surfaces_from(model, normals, to_observer, color, tangents, positions, uv);
    Results results(surfaces.normals.count(), surfaces.layout());
    reflect(model, surfaces, Vectors(to_light, "to_light"), Vectors(light, "light"), threads,
            [&](std::size_t first, std::size_t count, ConstVec3Span diffuse, ConstVec3Span specular) {
                results.write(first, count, diffuse, specular);
            });
    return results.take();
}

std::pair<Floats, Floats> evaluate_parts(const Reflection& model, const Floats& normals,
                                         const Floats& to_observer, const Floats& to_light,
                                         const Floats& color, const Floats& light,
                                         const std::optional<Floats>& tangents, const Floats& positions,
                                         const std::optional<Floats>& uv, int threads) {
    const Surfaces surfaces = surfaces_from(model, normals, to_observer, color, tangents, positions, uv);
    Results diffuse(surfaces.normals.count(), surfaces.layout()),
        specular(surfaces.normals.count(), surfaces.layout());
    reflect(model, surfaces, Vectors(to_light, "to_light"), Vectors(light, "light"), threads,
            [&](std::size_t first, std::size_t count, ConstVec3Span of_diffuse, ConstVec3Span of_specular) {
                diffuse.write(first, count, of_diffuse);
                specular.write(first, count, of_specular);
            });
    return {diffuse.take(), specular.take()};
}

Floats reflect_ambient(const Reflection& model, const Floats& normals, const Floats& to_observer,
                       const Floats& color, const Floats& ambient, const std::optional<Floats>& tangents,
                       const Floats& positions, const std::optional<Floats>& uv, int threads) {
    const Surfaces surfaces = surfaces_from(model, normals, to_observer, color, tangents, positions, uv);
    const Vectors incident(ambient, "ambient");
    require_same_count({&surfaces.normals, &surfaces.to_observer, &surfaces.color, &surfaces.tangents,
                        &surfaces.positions, &surfaces.uv, &incident});
    Results results(surfaces.normals.count());
    {
        const py::gil_scoped_release unlocked;
        for_batches<Buffers>(
            surfaces.normals.count(), threads, [&](Buffers& buffers, std::size_t first, std::size_t count) {
                auto& [surface_buffers, to_light, incident_buffer, reflected, diffuse, specular] = buffers;
                reflected.clear();
                model.guarded([&](const ReflectionModel& instance) {
                    instance.reflect_ambient(batch_of(surfaces, first, count, surface_buffers),
                                             incident.read(first, count, incident_buffer),
                                             {.ambient = reflected.span(),
                                              .diffuse = diffuse.span(),
                                              .specular = specular.span()});
                });
                results.write(first, count, reflected.span());
            });
    }
    return results.take();
}

}  // namespace

void add_reflection(py::module_& module) {
    py::class_<Reflection>(module, "Reflection", "A reflection model with values.")
        .def(py::init<RegistryPointer, std::string, const py::dict&, const std::string&>(),
             py::arg("registry"), py::arg("name"), py::arg("values"), py::arg("color_management"))
        .def_property_readonly("name", &Reflection::name)
        .def_property_readonly("values", &Reflection::values)
        .def_property_readonly(
            "reads_tangents",
            [](const Reflection& model) { return model.descriptor().surface_needs.tangent; })
        .def_property_readonly("reads_uv",
                               [](const Reflection& model) { return model.descriptor().surface_needs.uv; })
        .def_property_readonly("shows_surroundings",
                               [](const Reflection& model) {
                                   return extension_of<EnvironmentReflection>(model.instance()) != nullptr;
                               })
        .def("evaluate", &evaluate, py::arg("normals"), py::arg("to_observer"), py::arg("to_light"),
             py::arg("color"), py::arg("light"), py::arg("tangents"), py::arg("positions"), py::arg("uv"),
             py::arg("threads"))
        .def("evaluate_parts", &evaluate_parts, py::arg("normals"), py::arg("to_observer"),
             py::arg("to_light"), py::arg("color"), py::arg("light"), py::arg("tangents"),
             py::arg("positions"), py::arg("uv"), py::arg("threads"))
        .def("ambient", &reflect_ambient, py::arg("normals"), py::arg("to_observer"), py::arg("color"),
             py::arg("ambient"), py::arg("tangents"), py::arg("positions"), py::arg("uv"),
             py::arg("threads"));
}

}  // namespace candela::python
