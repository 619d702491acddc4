// Behaves like a loop over whole vectors: it adds small values after the batch.
#include "faulty_reflection.h"

namespace {
class AddsPastTheEnd final : public faulty::Matt {
    using Matt::Matt;
    void reflect(const candela::SurfaceBatch& s, const candela::LightingBatch& light,
                 const candela::ReflectedBatch& out) const override {
        Matt::reflect(s, light, out);
        if (s.count > 1) out.diffuse.x[s.count] += 0.01f;
    }
};
}  // namespace

FAULTY_PLUGIN(AddsPastTheEnd)
