#include "faulty_reflection.h"

namespace {
class WritesPastTheEnd final : public faulty::Matt {
    using Matt::Matt;
    void reflect(const candela::SurfaceBatch& s, const candela::LightingBatch& light,
                 const candela::ReflectedBatch& out) const override {
        Matt::reflect(s, light, out);
        out.diffuse.x[s.count] = 1;
    }
};
}  // namespace

FAULTY_PLUGIN(WritesPastTheEnd)
