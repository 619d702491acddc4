// Processes eight points at a time, and forgets the remainder.
#include "museum.h"

namespace {
class Miscounts final : public museum::Matt {
    using Matt::Matt;
    void reflect(const candela::SurfaceBatch& s, const candela::LightingBatch& light,
                 const candela::ReflectedBatch& out) const override {
        candela::SurfaceBatch eights = s;
        eights.count = s.count / 8 * 8;
        Matt::reflect(eights, light, out);
    }
};
}  // namespace

MUSEUM_PIECE(Miscounts)
