#include <unistd.h>

#include "museum.h"

namespace {
class NeverReturns final : public museum::Matt {
    using Matt::Matt;
    void reflect(const candela::SurfaceBatch&, const candela::LightingBatch&,
                 const candela::ReflectedBatch&) const override {
        for (;;) ::pause();
    }
};
}  // namespace

MUSEUM_PIECE(NeverReturns)
