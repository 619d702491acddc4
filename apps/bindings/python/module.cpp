// candela._candela: the core of the package `candela`, which people import. The package's modules have the
// documentation, give arrays the shapes that these functions expect, and define the public names.
#include "module.h"

namespace candela::python {

PYBIND11_MODULE(_candela, module) {
    module.doc() = "Candela's core for the package candela; import that instead.";
    module.attr("__version__") = CANDELA_VERSION;
    add_errors(module);
    add_registry(module);
    add_images(module);
    add_scene(module);
    add_renderer(module);
    add_light(module);
    add_reflection(module);
    add_shading(module);
    add_explaining(module);
    add_kernel(module);
}

}  // namespace candela::python
