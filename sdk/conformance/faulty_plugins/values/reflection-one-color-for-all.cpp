// Lights every point in the colour of the whole object, whatever colour the point has.
#include "faulty_reflection.h"

namespace candela::kernel {
struct OneColorMaterial {
    vec3 kd;
};
KERNEL vec3 one_color_reflect_ambient(OneColorMaterial m, Surface s) { return m.kd * s.color; }
KERNEL Reflected one_color_reflect(OneColorMaterial m, Surface s, vec3 to_light) {
    return Reflected(m.kd * s.color * max(dot(s.normal, to_light), 0.0f), vec3(0.0f));
}
}  // namespace candela::kernel

namespace {
using Sound =
    candela::sdk::KernelReflection<candela::kernel::OneColorMaterial, &candela::kernel::one_color_reflect,
                                   &candela::kernel::one_color_reflect_ambient>;
class OneColorForAll final : public Sound {
  public:
    explicit OneColorForAll(const faulty::Params& params) : Sound({params.kd}) {}
    void reflect(const candela::SurfaceBatch& surface, const candela::LightingBatch& light,
                 const candela::ReflectedBatch& reflected) const override {
        candela::SurfaceBatch uniform = surface;
        uniform.point_color = {};
        Sound::reflect(uniform, light, reflected);
    }
};
}  // namespace

FAULTY_PLUGIN(OneColorForAll)
