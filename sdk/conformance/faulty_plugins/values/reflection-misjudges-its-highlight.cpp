// Has a narrow highlight, and says that it is wide.
#include "faulty_reflection.h"

namespace candela::kernel {
struct MisjudgedMaterial {
    vec3 kd;
};
KERNEL vec3 misjudged_reflect_ambient(MisjudgedMaterial m, Surface s) { return m.kd * s.color; }
KERNEL Reflected misjudged_reflect(MisjudgedMaterial m, Surface s, vec3 to_light) {
    vec3 h = normalize(to_light + s.to_observer);
    vec3 aside = cross(s.normal, h);
    float a2 = 1.0e-4f;
    float q = dot(aside, aside) / a2 + dot(s.normal, h) * dot(s.normal, h);
    float n_dot_l = max(dot(s.normal, to_light), 0.0f);
    return Reflected(m.kd * s.color * n_dot_l, vec3(0.1f * n_dot_l / (a2 * q * q)));
}
KERNEL float misjudged_highlight_width(MisjudgedMaterial m) { return 0.9f; }
}  // namespace candela::kernel

namespace {
using Sound = candela::sdk::KernelGlossyReflection<
    candela::kernel::MisjudgedMaterial, &candela::kernel::misjudged_reflect,
    &candela::kernel::misjudged_reflect_ambient, &candela::kernel::misjudged_highlight_width>;
class Misjudged final : public Sound {
  public:
    explicit Misjudged(const faulty::Params& params) : Sound({params.kd}) {}
};
}  // namespace

FAULTY_PLUGIN(Misjudged)
