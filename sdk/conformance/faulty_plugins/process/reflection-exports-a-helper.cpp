// Built without the SDK's export list, so that its helper is visible to all other plugins.
#include "faulty_reflection.h"

[[gnu::visibility("default")]] float matt_factor(float cosine);
float matt_factor(float cosine) { return cosine > 0 ? cosine : 0; }

namespace {
class ExportsAHelper final : public faulty::Matt {
  public:
    using Matt::Matt;

  private:
    float factor(const candela::SurfaceBatch& s, const candela::LightingBatch& light,
                 std::size_t i) const override {
        return kd_ * matt_factor(dot(s.normal[i], light.to_light[i]));
    }
};
}  // namespace

FAULTY_PLUGIN(ExportsAHelper)
