// Between its two loops, another thread may write to the memory that all threads share.
#include <array>

#include "faulty_reflection.h"

namespace {
std::array<float, 4096> scratch;
class SharesItsScratch final : public faulty::Matt {
    using Matt::Matt;
    void reflect(const candela::SurfaceBatch& s, const candela::LightingBatch& light,
                 const candela::ReflectedBatch& out) const override {
        for (std::size_t i = 0; i < s.count; ++i) scratch[i] = factor(s, light, i);
        for (std::size_t i = 0; i < s.count; ++i) add(out.diffuse, i, scratch[i], light.diffuse[i]);
    }
};
}  // namespace

FAULTY_PLUGIN(SharesItsScratch)
