// A mirror that reflects more light than it receives.
#include <vector>

#include "faulty_reflection.h"

namespace {
class OutshinesItsSurroundings final : public faulty::Matt, public candela::EnvironmentReflection {
    using Matt::Matt;
    void show_environment(const candela::SurfaceBatch& s, candela::Environment& environment,
                          const candela::ReflectedBatch& out) const override {
        std::vector<float> seen(3 * s.count);
        const candela::Vec3Span span{seen.data(), seen.data() + s.count, seen.data() + 2 * s.count};
        environment.look(s.count, s.normal, span);
        for (std::size_t i = 0; i < s.count; ++i) add(out.specular, i, 1.2f, span[i]);
    }
};
}  // namespace

FAULTY_PLUGIN(OutshinesItsSurroundings)
