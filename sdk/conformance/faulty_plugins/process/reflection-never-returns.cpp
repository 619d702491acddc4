#include <unistd.h>

#include "faulty_reflection.h"

namespace {
class NeverReturns final : public faulty::Matt {
    using Matt::Matt;
    void reflect(const candela::SurfaceBatch&, const candela::LightingBatch&,
                 const candela::ReflectedBatch&) const override {
        for (;;) ::pause();
    }
};
}  // namespace

FAULTY_PLUGIN(NeverReturns)
