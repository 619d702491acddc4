// Reads two past the last point without using the value.
#include "faulty_reflection.h"

namespace {
class ReadsBehindTheBatch final : public faulty::Matt {
    using Matt::Matt;
    void reflect(const candela::SurfaceBatch& s, const candela::LightingBatch& light,
                 const candela::ReflectedBatch& out) const override {
        Matt::reflect(s, light, out);
        [[maybe_unused]] const volatile float next = s.normal.x[s.count + 1];
    }
};
}  // namespace

FAULTY_PLUGIN(ReadsBehindTheBatch)
