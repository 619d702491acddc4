// Returns the direction in which its light travels instead of the direction to the light.
#include "faulty_light.h"

namespace {
class PointsAway final : public faulty::Lamp {
    using Lamp::Lamp;
    candela::Vec3 direction(candela::Vec3 towards) const override { return -towards; }
};
}  // namespace

FAULTY_LIGHT(PointsAway)
