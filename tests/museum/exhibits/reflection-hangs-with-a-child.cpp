// Starts a process that leaves the session, and never returns.
#include <unistd.h>

#include "museum.h"

namespace {
class HangsWithAChild final : public museum::Matt {
    using Matt::Matt;
    void reflect(const candela::SurfaceBatch&, const candela::LightingBatch&,
                 const candela::ReflectedBatch&) const override {
        if (::fork() == 0) ::setsid();
        for (;;) ::pause();
    }
};
}  // namespace

MUSEUM_PIECE(HangsWithAChild)
