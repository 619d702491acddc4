// Reads before the first point without using the value.
#include "faulty_reflection.h"

namespace {
class ReadsBeforeTheBatch final : public faulty::Matt {
    using Matt::Matt;
    void reflect_ambient(const candela::SurfaceBatch& s, const candela::ConstVec3Span& ambient,
                         const candela::ReflectedBatch& out) const override {
        Matt::reflect_ambient(s, ambient, out);
        [[maybe_unused]] const volatile float previous = *(ambient.z - 1);
    }
};
}  // namespace

FAULTY_PLUGIN(ReadsBeforeTheBatch)
