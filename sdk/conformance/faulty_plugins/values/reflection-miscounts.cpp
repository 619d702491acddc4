// Processes eight points at a time, and forgets the remainder.
#include "faulty_reflection.h"

namespace {
class Miscounts final : public faulty::Matt {
    using Matt::Matt;
    void reflect(const candela::SurfaceBatch& s, const candela::LightingBatch& light,
                 const candela::ReflectedBatch& out) const override {
        candela::SurfaceBatch eights = s;
        eights.count = s.count / 8 * 8;
        Matt::reflect(eights, light, out);
    }
};
}  // namespace

FAULTY_PLUGIN(Miscounts)
