#include "faulty_reflection.h"

namespace {
class IsNegative final : public faulty::Matt {
    using Matt::Matt;
    float factor(const candela::SurfaceBatch& s, const candela::LightingBatch& light,
                 std::size_t i) const override {
        return kd_ * dot(s.normal[i], light.to_light[i]);
    }
};
}  // namespace

FAULTY_PLUGIN(IsNegative)
