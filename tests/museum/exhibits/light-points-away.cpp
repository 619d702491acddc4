// Returns the direction in which its light travels instead of the direction to the light.
#include "museum_light.h"

namespace {
class PointsAway final : public museum::Lamp {
    using Lamp::Lamp;
    candela::Vec3 direction(candela::Vec3 towards) const override { return -towards; }
};
}  // namespace

MUSEUM_LAMP(PointsAway)
