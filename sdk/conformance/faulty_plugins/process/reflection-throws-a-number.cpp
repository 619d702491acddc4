// Throws an object that is not a std::exception.
#include "faulty_reflection.h"

namespace {
class ThrowsANumber final : public faulty::Matt {
    using Matt::Matt;
    void reflect(const candela::SurfaceBatch&, const candela::LightingBatch&,
                 const candela::ReflectedBatch&) const override {
        throw 42;
    }
};
}  // namespace

FAULTY_PLUGIN(ThrowsANumber)
