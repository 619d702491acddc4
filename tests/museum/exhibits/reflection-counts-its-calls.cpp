// A data race that changes no result: of all that the kit does, only ThreadSanitizer sees it.
#include "museum.h"

namespace {
class CountsItsCalls final : public museum::Matt {
    using Matt::Matt;
    void reflect(const candela::SurfaceBatch& s, const candela::LightingBatch& light,
                 const candela::ReflectedBatch& out) const override {
        ++calls_;
        Matt::reflect(s, light, out);
    }
    mutable long calls_ = 0;
};
}  // namespace

MUSEUM_PIECE(CountsItsCalls)
