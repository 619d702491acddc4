#include <cstdlib>

#include "faulty_reflection.h"

namespace {
class Aborts final : public faulty::Matt {
    using Matt::Matt;
    void reflect(const candela::SurfaceBatch&, const candela::LightingBatch&,
                 const candela::ReflectedBatch&) const override {
        std::abort();
    }
};
}  // namespace

FAULTY_PLUGIN(Aborts)
