#include <unistd.h>

#include "faulty_reflection.h"

namespace {
class CallsExit final : public faulty::Matt {
    using Matt::Matt;
    void reflect(const candela::SurfaceBatch&, const candela::LightingBatch&,
                 const candela::ReflectedBatch&) const override {
        ::_exit(0);
    }
};
}  // namespace

FAULTY_PLUGIN(CallsExit)
