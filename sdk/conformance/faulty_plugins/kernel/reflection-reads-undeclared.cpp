// Its kernel reads texture coordinates without declaring them, so that the host does not fill them.
#include "candela/reflection_plugin.h"

namespace candela::kernel {
#include "reflection-reads-undeclared.kernel"
}

using candela::kernel::ReadsUndeclaredMaterial;
using namespace candela::sdk;

constexpr auto k_fields =
    fields(coefficient(&ReadsUndeclaredMaterial::kd, "kd", 0.7f, "how much light is reflected diffusely"));

CANDELA_KERNEL_PLUGIN(reflection,
                      (KernelReflection<ReadsUndeclaredMaterial, &candela::kernel::reads_undeclared_reflect,
                                        &candela::kernel::reads_undeclared_reflect_ambient>),
                      reads_undeclared, ReadsUndeclaredMaterial, k_fields,
                      {.title = "Reads undeclared", .summary = "Bad on purpose.", .reference = "none"})
