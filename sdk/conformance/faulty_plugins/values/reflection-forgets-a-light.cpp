// Correct light by light, but omits the last light when called with all lights at once.
#include "faulty_reflection.h"

namespace candela::kernel {
struct ForgetsMaterial {
    vec3 kd;
};
KERNEL vec3 forgets_reflect_ambient(ForgetsMaterial m, Surface s) { return m.kd * s.color; }
KERNEL Reflected forgets_reflect(ForgetsMaterial m, Surface s, vec3 to_light) {
    return Reflected(m.kd * s.color * max(dot(s.normal, to_light), 0.0f), vec3(0.0f));
}
}  // namespace candela::kernel

namespace {
using Sound =
    candela::sdk::KernelReflection<candela::kernel::ForgetsMaterial, &candela::kernel::forgets_reflect,
                                   &candela::kernel::forgets_reflect_ambient>;
class ForgetsALight final : public Sound {
  public:
    explicit ForgetsALight(const faulty::Params& params) : Sound({params.kd}) {}
    void reflect_all_lights(const candela::SurfaceBatch& surface, const candela::PunctualLighting& lighting,
                            const candela::Vec3Span& intensity) const override {
        candela::PunctualLighting most = lighting;
        if (!most.lights.empty()) most.lights = most.lights.first(most.lights.size() - 1);
        Sound::reflect_all_lights(surface, most, intensity);
    }
};
}  // namespace

FAULTY_PLUGIN(ForgetsALight)
