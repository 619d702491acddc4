// Declares to fade by distance, but is equally bright everywhere.
#include "museum_light.h"

namespace {
class NeverFades final : public museum::Lamp {
    using Lamp::Lamp;
    float intensity(float) const override { return 1; }
};
}  // namespace

MUSEUM_LAMP(NeverFades)
