// Exports a table for programs that differs from the one that it computes with.
#include "candela/reflection_plugin.h"

namespace candela::kernel {
#include "reflection-exports-another-table.kernel"
}

using candela::kernel::ExportsAnotherTableMaterial;
using namespace candela::sdk;

namespace {

constexpr float k_ramp[] = {0.5f, 0.25f};
constexpr float k_other[] = {0.5f, 0.75f};

constexpr auto k_fields =
    fields(numbers(&ExportsAnotherTableMaterial::ramp, "ramp", k_ramp, "by the cosine").range(0, 1));

}  // namespace

using Computed =
    KernelReflection<ExportsAnotherTableMaterial, &candela::kernel::exports_another_table_reflect,
                     &candela::kernel::exports_another_table_reflect_ambient>;

class ExportsAnotherTable : public Computed {
  public:
    explicit ExportsAnotherTable(const ExportsAnotherTableMaterial&) : Computed(other()) {}

  private:
    static ExportsAnotherTableMaterial other() {
        ExportsAnotherTableMaterial material;
        material.ramp.numbers = k_other;
        material.ramp.count = 2;
        return material;
    }
};

CANDELA_KERNEL_PLUGIN(reflection, ExportsAnotherTable, exports_another_table, ExportsAnotherTableMaterial,
                      k_fields,
                      {.title = "Exports another table", .summary = "Bad on purpose.", .reference = "none"})
