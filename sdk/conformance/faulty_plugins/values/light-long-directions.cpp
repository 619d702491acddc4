// The direction to the light is not a unit vector, and its light grows with distance although it declares
// otherwise.
#include "faulty_light.h"

namespace {
class LongDirections final : public faulty::Lamp {
    using Lamp::Lamp;
    float intensity(float distance) const override { return distance; }
    candela::Vec3 direction(candela::Vec3 towards) const override { return 2 * towards; }
};
}  // namespace

FAULTY_LIGHT(LongDirections)
