// A data race that does not change results: of all the kit's checks, only ThreadSanitizer finds it.
#include "faulty_reflection.h"

namespace {
class CountsItsCalls final : public faulty::Matt {
    using Matt::Matt;
    void reflect(const candela::SurfaceBatch& s, const candela::LightingBatch& light,
                 const candela::ReflectedBatch& out) const override {
        ++calls_;
        Matt::reflect(s, light, out);
    }
    mutable long calls_ = 0;
};
}  // namespace

FAULTY_PLUGIN(CountsItsCalls)
