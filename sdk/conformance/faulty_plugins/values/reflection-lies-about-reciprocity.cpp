// Declares that light and observer may be exchanged, but depends only on the observer.
#include <algorithm>

#include "faulty_reflection.h"

namespace {
class LiesAboutReciprocity final : public faulty::Matt {
    using Matt::Matt;
    float factor(const candela::SurfaceBatch& s, const candela::LightingBatch& light,
                 std::size_t i) const override {
        return Matt::factor(s, light, i) * std::max(dot(s.normal[i], s.to_observer[i]), 0.0f);
    }
};
constexpr candela::Property k_properties[] = {{"reciprocal"}};
}  // namespace

FAULTY_PLUGIN(LiesAboutReciprocity, .properties = k_properties)
