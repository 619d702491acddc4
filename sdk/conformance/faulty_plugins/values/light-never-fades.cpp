// Declares to fade by distance, but is equally bright everywhere.
#include "faulty_light.h"

namespace {
class NeverFades final : public faulty::Lamp {
    using Lamp::Lamp;
    float intensity(float) const override { return 1; }
};
}  // namespace

FAULTY_LIGHT(NeverFades)
