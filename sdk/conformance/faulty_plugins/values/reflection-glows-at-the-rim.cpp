// Energy-bounded at most angles, but four times too bright beyond 87 degrees.
#include "faulty_reflection.h"

namespace {
class GlowsAtTheRim final : public faulty::Matt {
    using Matt::Matt;
    float factor(const candela::SurfaceBatch& s, const candela::LightingBatch& light,
                 std::size_t i) const override {
        return Matt::factor(s, light, i) * (dot(s.normal[i], s.to_observer[i]) < 0.05f ? 8.0f : 1.0f);
    }
};
constexpr candela::Property k_properties[] = {{"energy-bounded"}};
}  // namespace

FAULTY_PLUGIN(GlowsAtTheRim, .properties = k_properties)
