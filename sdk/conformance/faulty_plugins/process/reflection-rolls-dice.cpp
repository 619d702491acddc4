// Returns a different result each time.
#include <atomic>

#include "faulty_reflection.h"

namespace {
std::atomic<unsigned> rolls{1};
class RollsDice final : public faulty::Matt {
    using Matt::Matt;
    float factor(const candela::SurfaceBatch& s, const candela::LightingBatch& light,
                 std::size_t i) const override {
        rolls = rolls * 1664525u + 1013904223u;
        return Matt::factor(s, light, i) * static_cast<float>(rolls >> 16) / 65536.0f;
    }
};
}  // namespace

FAULTY_PLUGIN(RollsDice)
