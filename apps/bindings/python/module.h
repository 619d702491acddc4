// The parts of the module, each of which adds its classes and functions.
#pragma once

#include "binding.h"

namespace candela::python {

void add_errors(py::module_& module);
void add_registry(py::module_& module);
void add_scene(py::module_& module);
void add_renderer(py::module_& module);
void add_images(py::module_& module);
void add_light(py::module_& module);
void add_reflection(py::module_& module);
void add_shading(py::module_& module);
void add_explaining(py::module_& module);
void add_kernel(py::module_& module);

}  // namespace candela::python
