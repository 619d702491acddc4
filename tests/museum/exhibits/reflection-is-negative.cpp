#include "museum.h"

namespace {
class IsNegative final : public museum::Matt {
    using Matt::Matt;
    float factor(const candela::SurfaceBatch& s, const candela::LightingBatch& light,
                 std::size_t i) const override {
        return kd_ * dot(s.normal[i], light.to_light[i]);
    }
};
}  // namespace

MUSEUM_PIECE(IsNegative)
