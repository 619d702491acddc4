// Correct light by light, but writes one point too many, a NaN, when called with all lights at once.
#include <limits>

#include "faulty_reflection.h"

namespace {
class HastyAtTheEnd final : public faulty::Matt, public candela::AllLightsReflection {
    using Matt::Matt;
    void reflect_all_lights(const candela::SurfaceBatch& s, const candela::PunctualLighting&,
                            const candela::Vec3Span& out) const override {
        for (std::size_t i = 0; i <= s.count; ++i)
            out.set(i, {1, 1, std::numeric_limits<float>::quiet_NaN()});
    }
};
}  // namespace

FAULTY_PLUGIN(HastyAtTheEnd)
