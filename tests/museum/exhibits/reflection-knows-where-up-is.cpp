// Brighter where the surface looks up: turned with all that is around it, an object looks different.
#include "museum.h"

namespace {
class KnowsWhereUpIs final : public museum::Matt {
    using Matt::Matt;
    float factor(const candela::SurfaceBatch& s, const candela::LightingBatch& light,
                 std::size_t i) const override {
        return Matt::factor(s, light, i) * (0.8f + 0.2f * s.normal.y[i]);
    }
};
}  // namespace

MUSEUM_PIECE(KnowsWhereUpIs)
