// Says that its parameters may vary, and lights every point with those of the whole object.
#include "faulty_reflection.h"

namespace candela::kernel {
struct SameMaterial {
    vec3 kd;
};
KERNEL vec3 same_reflect_ambient(SameMaterial m, Surface s) { return m.kd * s.color; }
KERNEL Reflected same_reflect(SameMaterial m, Surface s, vec3 to_light) {
    return Reflected(m.kd * s.color * max(dot(s.normal, to_light), 0.0f), vec3(0.0f));
}
}  // namespace candela::kernel

namespace {
using Sound = candela::sdk::KernelReflection<candela::kernel::SameMaterial, &candela::kernel::same_reflect,
                                             &candela::kernel::same_reflect_ambient>;
class SameEverywhere final : public Sound {
  public:
    static constexpr candela::SurfaceNeeds k_needs{.varying = true};
    explicit SameEverywhere(const faulty::Params& params) : Sound({params.kd}) {}
};
}  // namespace

FAULTY_PLUGIN(SameEverywhere)
