#include <cstdlib>

#include "museum.h"

namespace {
class Aborts final : public museum::Matt {
    using Matt::Matt;
    void reflect(const candela::SurfaceBatch&, const candela::LightingBatch&,
                 const candela::ReflectedBatch&) const override {
        std::abort();
    }
};
}  // namespace

MUSEUM_PIECE(Aborts)
