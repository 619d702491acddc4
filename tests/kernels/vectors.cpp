#include <candela/reflection_plugin.h>

namespace candela::kernel {
#include "vectors.kernel"
}

using candela::kernel::VectorsMaterial;
using namespace candela::sdk;

constexpr auto k_fields = fields(diffuse_coefficient(&VectorsMaterial::kd),
                                 angle(&VectorsMaterial::turn, "turn", 30, "about the z axis").range(0, 180));
constexpr candela::Property k_properties[] = {{"fixed-in-world"}};

CANDELA_REFLECTION_PLUGIN(vectors, VectorsMaterial, k_fields,
                          {.title = "Vectors",
                           .summary = "The kernel language's vector functions.",
                           .formula = "(see its kernel)",
                           .properties = k_properties})
