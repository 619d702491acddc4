// All instances use the last one's parameters.
#include "museum.h"

namespace {
float last_kd = 0;
class SharesItsState final : public museum::Matt {
  public:
    explicit SharesItsState(const museum::Params& params) : Matt(params) { last_kd = params.kd.x; }

  private:
    float factor(const candela::SurfaceBatch& s, const candela::LightingBatch& light,
                 std::size_t i) const override {
        const float cosine = dot(s.normal[i], light.to_light[i]);
        return cosine > 0 ? last_kd * cosine : 0;
    }
};
}  // namespace

MUSEUM_PIECE(SharesItsState)
