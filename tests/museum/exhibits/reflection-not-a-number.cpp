// Takes the square root of a negative number where light comes from below.
#include <cmath>

#include "museum.h"

namespace {
class NotANumber final : public museum::Matt {
    using Matt::Matt;
    float factor(const candela::SurfaceBatch& s, const candela::LightingBatch& light,
                 std::size_t i) const override {
        return kd_ * std::sqrt(dot(s.normal[i], light.to_light[i]));
    }
};
}  // namespace

MUSEUM_PIECE(NotANumber)
