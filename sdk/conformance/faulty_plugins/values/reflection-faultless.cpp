// Without fault, to show that the faults found in the others are not in their shared code.
#include "faulty_reflection.h"

namespace {
constexpr candela::Property k_properties[] = {{"reciprocal"}, {"energy-bounded"}, {"isotropic"}};
using faulty::Matt;
}  // namespace

FAULTY_PLUGIN(Matt, .properties = k_properties)
