#include <stdexcept>

#include "faulty_reflection.h"

namespace {
class ThrowsInAmbient final : public faulty::Matt {
    using Matt::Matt;
    void reflect_ambient(const candela::SurfaceBatch&, const candela::ConstVec3Span&,
                         const candela::ReflectedBatch&) const override {
        throw std::runtime_error("no ambience");
    }
};
}  // namespace

FAULTY_PLUGIN(ThrowsInAmbient)
