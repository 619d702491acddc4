// Throws an object that is not a std::exception.
#include "museum.h"

namespace {
class ThrowsANumber final : public museum::Matt {
    using Matt::Matt;
    void reflect(const candela::SurfaceBatch&, const candela::LightingBatch&,
                 const candela::ReflectedBatch&) const override {
        throw 42;
    }
};
}  // namespace

MUSEUM_PIECE(ThrowsANumber)
