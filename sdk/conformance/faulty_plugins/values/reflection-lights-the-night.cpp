// Reflects light from below the horizon without declaring it.
#include "faulty_reflection.h"

namespace {
class LightsTheNight final : public faulty::Matt {
    using Matt::Matt;
    float factor(const candela::SurfaceBatch& s, const candela::LightingBatch& light,
                 std::size_t i) const override {
        return kd_ * (0.5f * dot(s.normal[i], light.to_light[i]) + 0.5f);
    }
};
}  // namespace

FAULTY_PLUGIN(LightsTheNight)
