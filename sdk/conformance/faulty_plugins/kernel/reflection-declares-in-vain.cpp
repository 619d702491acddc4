// Declares properties that do not exist, so that nothing would verify them.
#include "faulty_reflection.h"

namespace {
using DeclaresInVain = faulty::Matt;
constexpr candela::RelationSpec k_relations[] = {
    {candela::RelationType::sum_at_most_one, "kd", "kq", false, "more light leaves than arrives"}};
constexpr candela::Property k_properties[] = {
    {"recprocal"}, {"closed"}, {"isotropic", "where shape is round"}};
constexpr candela::PresetValue k_too_bright[] = {{"kd", {.number = {1.5f, 0.5f, 0.5f}}}};
constexpr candela::PresetSpec k_presets[] = {{.name = "plaster", .source = "nobody", .values = k_too_bright},
                                             {.name = "plaster", .source = "nobody"}};
}  // namespace

FAULTY_PLUGIN(DeclaresInVain, .relations = k_relations, .properties = k_properties, .presets = k_presets)
