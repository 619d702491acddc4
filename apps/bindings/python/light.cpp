// Lights, called on arrays.
#include "arrays.h"
#include "instances.h"
#include "module.h"

import candela.api;

namespace candela::python {

namespace {

using LightInstance = ModelInstance<Light>;

struct Buffers {
    BatchVectors position, normal, to_light, diffuse, specular;
};

void require_sample(const LightInstance& light, int sample) {
    const int count = light.instance().sample_count();
    if (sample < 0 || sample >= count)
        throw py::index_error(
            fmt::format("light/{} has no sample {}; its sample count is {}", light.name(), sample, count));
}

std::tuple<Floats, Floats, Floats> illuminate(const LightInstance& light, const Floats& points,
                                              const Floats& normals, int sample, int threads) {
    const Vectors positions(points, "points"), facing(normals, "normals");
    require_same_count({&positions, &facing});
    require_sample(light, sample);
    Results to_light(positions.count()), diffuse(positions.count()), specular(positions.count());
    {
        const py::gil_scoped_release unlocked;
        for_batches<Buffers>(positions.count(), threads,
                             [&](Buffers& buffers, std::size_t first, std::size_t count) {
                                 auto& [position, normal, towards, of_diffuse, of_specular] = buffers;
                                 light.guarded([&](const Light& instance) {
                                     instance.illuminate(sample,
                                                         {.count = count,
                                                          .position = positions.read(first, count, position),
                                                          .normal = facing.read(first, count, normal)},
                                                         {.to_light = towards.span(),
                                                          .diffuse = of_diffuse.span(),
                                                          .specular = of_specular.span()});
                                 });
                                 to_light.write(first, count, towards.span());
                                 diffuse.write(first, count, of_diffuse.span());
                                 specular.write(first, count, of_specular.span());
                             });
    }
    return {to_light.take(), diffuse.take(), specular.take()};
}

Floats illuminate_ambient(const LightInstance& light, const Floats& points, const Floats& normals,
                          int threads) {
    const Vectors positions(points, "points"), facing(normals, "normals");
    require_same_count({&positions, &facing});
    Results ambient(positions.count());
    {
        const py::gil_scoped_release unlocked;
        for_batches<Buffers>(
            positions.count(), threads, [&](Buffers& buffers, std::size_t first, std::size_t count) {
                auto& [position, normal, towards, intensity, specular] = buffers;
                intensity.clear();
                if (light.descriptor().has_ambient) {
                    light.guarded([&](const Light& instance) {
                        instance.illuminate_ambient({.count = count,
                                                     .position = positions.read(first, count, position),
                                                     .normal = facing.read(first, count, normal)},
                                                    intensity.span());
                    });
                }
                ambient.write(first, count, intensity.span());
            });
    }
    return ambient.take();
}

}  // namespace

void add_light(py::module_& module) {
    py::class_<LightInstance>(module, "Light", "A light with values.")
        .def(py::init<RegistryPointer, std::string, const py::dict&, const std::string&>(),
             py::arg("registry"), py::arg("name"), py::arg("values"), py::arg("color_management"))
        .def_property_readonly("name", &LightInstance::name)
        .def_property_readonly("values", &LightInstance::values)
        .def_property_readonly("sample_count",
                               [](const LightInstance& light) { return light.instance().sample_count(); })
        .def_property_readonly("has_ambient",
                               [](const LightInstance& light) { return light.descriptor().has_ambient; })
        .def("illuminate", &illuminate, py::arg("points"), py::arg("normals"), py::arg("sample"),
             py::arg("threads"))
        .def("ambient", &illuminate_ambient, py::arg("points"), py::arg("normals"), py::arg("threads"));
}

}  // namespace candela::python
