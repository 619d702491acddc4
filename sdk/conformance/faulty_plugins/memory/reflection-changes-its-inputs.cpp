#include "faulty_reflection.h"

namespace {
class ChangesItsInputs final : public faulty::Matt {
    using Matt::Matt;
    void reflect(const candela::SurfaceBatch& s, const candela::LightingBatch& light,
                 const candela::ReflectedBatch& out) const override {
        const_cast<float*>(s.normal.x)[0] = 0.5f;
        Matt::reflect(s, light, out);
    }
};
}  // namespace

FAULTY_PLUGIN(ChangesItsInputs)
