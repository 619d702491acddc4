// Its kernel reads texture coordinates without declaring them, so that the host does not fill them.
#include "candela/reflection_plugin.h"

namespace candela::kernel {
#include "reflection-reads-undeclared.kernel"
}

using candela::kernel::ReadsUndeclaredMaterial;
using namespace candela::sdk;

constexpr auto k_fields = fields(diffuse_coefficient(&ReadsUndeclaredMaterial::kd));

CANDELA_REFLECTION_PLUGIN(reads_undeclared, ReadsUndeclaredMaterial, k_fields,
                          {.title = "Reads undeclared", .summary = "Bad on purpose.", .reference = "none"})
