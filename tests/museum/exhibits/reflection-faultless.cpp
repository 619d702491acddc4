// Without fault, to show that the faults found in the others are not in their shared code.
#include "museum.h"

namespace {
constexpr candela::Property k_properties[] = {{"reciprocal"}, {"energy-bounded"}, {"isotropic"}};
using museum::Matt;
}  // namespace

MUSEUM_PIECE(Matt, .properties = k_properties)
