// Brighter where the surface faces up: an object turned together with its surroundings looks different.
#include "faulty_reflection.h"

namespace {
class KnowsWhereUpIs final : public faulty::Matt {
    using Matt::Matt;
    float factor(const candela::SurfaceBatch& s, const candela::LightingBatch& light,
                 std::size_t i) const override {
        return Matt::factor(s, light, i) * (0.8f + 0.2f * s.normal.y[i]);
    }
};
}  // namespace

FAULTY_PLUGIN(KnowsWhereUpIs)
