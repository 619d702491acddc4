// Compiles models at run time.
#include "candela/kernel_language/kernel_cache.h"
#include "candela/kernel_language/model_compiler.h"

#include "binding.h"
#include "module.h"

import candela.plugins;

namespace candela::python {

namespace {

/// The folder of the plugin.
std::string compile_model(const std::string& source, const std::string& name) {
    return kernel_language::compile_model({name + ".kernel", source}, name, kernel_language::kernel_cache())
        .folder.string();
}

}  // namespace

void add_kernel(py::module_& module) {
    module.def("compile_model", &compile_model, py::arg("source"), py::arg("name"),
               py::call_guard<py::gil_scoped_release>(),
               "Makes a plugin of the text of a model's kernel, and returns the folder that contains it.");
}

}  // namespace candela::python
