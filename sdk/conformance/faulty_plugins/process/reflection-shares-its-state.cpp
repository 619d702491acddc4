// All instances use the last one's parameters.
#include "faulty_reflection.h"

namespace {
float last_kd = 0;
class SharesItsState final : public faulty::Matt {
  public:
    explicit SharesItsState(const faulty::Params& params) : Matt(params) { last_kd = params.kd.x; }

  private:
    float factor(const candela::SurfaceBatch& s, const candela::LightingBatch& light,
                 std::size_t i) const override {
        const float cosine = dot(s.normal[i], light.to_light[i]);
        return cosine > 0 ? last_kd * cosine : 0;
    }
};
}  // namespace

FAULTY_PLUGIN(SharesItsState)
