// Declares that its energy is bounded, but reflects three times what it should.
#include "museum.h"

namespace {
class MakesEnergy final : public museum::Matt {
    using Matt::Matt;
    float factor(const candela::SurfaceBatch& s, const candela::LightingBatch& light,
                 std::size_t i) const override {
        return 3 * Matt::factor(s, light, i);
    }
};
constexpr candela::Property k_properties[] = {{"energy-bounded"}};
}  // namespace

MUSEUM_PIECE(MakesEnergy, .properties = k_properties)
