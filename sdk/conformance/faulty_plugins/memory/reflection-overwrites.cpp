// Writes its share where it should add it.
#include "faulty_reflection.h"

namespace {
class Overwrites final : public faulty::Matt {
    using Matt::Matt;
    void reflect(const candela::SurfaceBatch& s, const candela::LightingBatch& light,
                 const candela::ReflectedBatch& out) const override {
        for (std::size_t i = 0; i < s.count; ++i) out.diffuse.set(i, factor(s, light, i) * light.diffuse[i]);
    }
};
}  // namespace

FAULTY_PLUGIN(Overwrites)
