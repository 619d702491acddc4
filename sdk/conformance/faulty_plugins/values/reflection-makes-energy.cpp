// Declares that its energy is bounded, but reflects three times what it should.
#include "faulty_reflection.h"

namespace {
class MakesEnergy final : public faulty::Matt {
    using Matt::Matt;
    float factor(const candela::SurfaceBatch& s, const candela::LightingBatch& light,
                 std::size_t i) const override {
        return 3 * Matt::factor(s, light, i);
    }
};
constexpr candela::Property k_properties[] = {{"energy-bounded"}};
}  // namespace

FAULTY_PLUGIN(MakesEnergy, .properties = k_properties)
