// Brushed along its tangent, but declared isotropic.
#include "faulty_reflection.h"

namespace {
class LiesAboutIsotropy final : public faulty::Matt {
  public:
    using Matt::Matt;
    static constexpr candela::SurfaceNeeds k_needs{.tangent = true};

  private:
    float factor(const candela::SurfaceBatch& s, const candela::LightingBatch& light,
                 std::size_t i) const override {
        const float along = dot(s.tangent[i], light.to_light[i]);
        return Matt::factor(s, light, i) * along * along;
    }
};
constexpr candela::Property k_properties[] = {{"isotropic"}};
}  // namespace

FAULTY_PLUGIN(LiesAboutIsotropy, .properties = k_properties)
