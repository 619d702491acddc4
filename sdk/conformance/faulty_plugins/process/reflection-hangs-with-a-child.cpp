// Starts a process that leaves the session, and never returns.
#include <unistd.h>

#include "faulty_reflection.h"

namespace {
class HangsWithAChild final : public faulty::Matt {
    using Matt::Matt;
    void reflect(const candela::SurfaceBatch&, const candela::LightingBatch&,
                 const candela::ReflectedBatch&) const override {
        if (::fork() == 0) ::setsid();
        for (;;) ::pause();
    }
};
}  // namespace

FAULTY_PLUGIN(HangsWithAChild)
