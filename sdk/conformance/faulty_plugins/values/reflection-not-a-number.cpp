// Takes the square root of a negative number where light comes from below.
#include <cmath>

#include "faulty_reflection.h"

namespace {
class NotANumber final : public faulty::Matt {
    using Matt::Matt;
    float factor(const candela::SurfaceBatch& s, const candela::LightingBatch& light,
                 std::size_t i) const override {
        return kd_ * std::sqrt(dot(s.normal[i], light.to_light[i]));
    }
};
}  // namespace

FAULTY_PLUGIN(NotANumber)
