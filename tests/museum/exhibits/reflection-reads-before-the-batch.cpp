// Reads before the first point without using the value.
#include "museum.h"

namespace {
class ReadsBeforeTheBatch final : public museum::Matt {
    using Matt::Matt;
    void reflect_ambient(const candela::SurfaceBatch& s, const candela::ConstVec3Span& ambient,
                         const candela::ReflectedBatch& out) const override {
        Matt::reflect_ambient(s, ambient, out);
        [[maybe_unused]] const volatile float previous = *(ambient.z - 1);
    }
};
}  // namespace

MUSEUM_PIECE(ReadsBeforeTheBatch)
