// Each point reads the next one, even the last. A NaN there is hidden.
#include "faulty_reflection.h"

namespace {
class ReadsPastTheEnd final : public faulty::Matt {
    using Matt::Matt;
    float factor(const candela::SurfaceBatch& s, const candela::LightingBatch& light,
                 std::size_t i) const override {
        const float next = s.to_observer.x[i + 1];
        return Matt::factor(s, light, i) * (next > 0.5f ? 0.9f : 1.0f);
    }
};
}  // namespace

FAULTY_PLUGIN(ReadsPastTheEnd)
