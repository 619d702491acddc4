// candela._candela: what the package `candela` is made of. It is the package that people import; its modules
// have the documentation, give arrays the shapes that the functions here expect, and are where the names come
// from.
#include "module.h"

namespace candela::python {

PYBIND11_MODULE(_candela, module) {
    module.doc() = "Candela's core for the package candela, which is what to import.";
    module.attr("__version__") = CANDELA_VERSION;
    add_errors(module);
    add_registry(module);
    add_pictures(module);
    add_scene(module);
    add_renderer(module);
    add_light(module);
    add_reflection(module);
    add_shading(module);
    add_explaining(module);
    add_kernel(module);
}

}  // namespace candela::python
