// Nothing is wrong with it: what the kit finds in the others is not in what they share.
#include "museum.h"

namespace {
constexpr candela::Property k_properties[] = {{"reciprocal"}, {"energy-bounded"}, {"isotropic"}};
using museum::Matt;
}  // namespace

MUSEUM_PIECE(Matt, .properties = k_properties)
