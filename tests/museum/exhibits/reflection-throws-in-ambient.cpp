#include <stdexcept>

#include "museum.h"

namespace {
class ThrowsInAmbient final : public museum::Matt {
    using Matt::Matt;
    void reflect_ambient(const candela::SurfaceBatch&, const candela::ConstVec3Span&,
                         const candela::ReflectedBatch&) const override {
        throw std::runtime_error("no ambience");
    }
};
}  // namespace

MUSEUM_PIECE(ThrowsInAmbient)
