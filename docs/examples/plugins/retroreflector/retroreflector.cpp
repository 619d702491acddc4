// Written by hand against the interface, without a kernel.
#include <candela/plugin.h>
#include <candela/reflection_model.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

using candela::ConstVec3Span;
using candela::Vec3;
using candela::Vec3Span;
using namespace candela::sdk;

namespace {

struct Params {
    vec3 ka, kd, ks;
    float sharpness;
    std::int32_t stripes;
};

/// Adds the light, times a factor and C_o, channel by channel.
void add(const Vec3Span& sum, std::size_t i, vec3 factor, Vec3 color, Vec3 light) {
    sum.set(i, sum[i] + Vec3{factor.x * color.x * light.x, factor.y * color.y * light.y,
                             factor.z * color.z * light.z});
}

class Retroreflector final : public candela::ReflectionModel {
  public:
    static constexpr candela::SurfaceNeeds k_needs{.uv = true};

    explicit Retroreflector(const Params& params) : params_(params) {}

    void reflect(const candela::SurfaceBatch& surface, const candela::LightingBatch& light,
                 const candela::ReflectedBatch& reflected) const override {
        for (std::size_t i = 0; i < surface.count; ++i) {
            const Vec3 to_light = light.to_light[i];
            const float facing = dot(surface.normal[i], to_light);
            if (!(facing > 0)) continue;
            add(reflected.diffuse, i, facing * params_.kd, color(surface, i), light.diffuse[i]);
            if (!has_beads(surface.uv.y[i])) continue;
            const float back = std::max(dot(surface.to_observer[i], to_light), 0.0f);
            const float share = facing * std::pow(back, params_.sharpness);
            add(reflected.specular, i, share * params_.ks, {1, 1, 1}, light.specular[i]);
        }
    }

    void reflect_ambient(const candela::SurfaceBatch& surface, const ConstVec3Span& ambient,
                         const candela::ReflectedBatch& reflected) const override {
        for (std::size_t i = 0; i < surface.count; ++i)
            add(reflected.ambient, i, params_.ka, color(surface, i), ambient[i]);
    }

  private:
    static Vec3 color(const candela::SurfaceBatch& surface, std::size_t i) {
        if (surface.point_color) return surface.point_color[i];
        return {surface.color.r, surface.color.g, surface.color.b};
    }

    bool has_beads(float v) const {
        const float place = v * static_cast<float>(params_.stripes);
        return place - std::floor(place) < 0.5f;
    }

    Params params_;
};

constexpr auto k_fields = fields(
    coefficient(&Params::ka, "ka", 0.1f, "how much ambient light is reflected"),
    coefficient(&Params::kd, "kd", 0.4f, "how much light is reflected diffusely"),
    coefficient(&Params::ks, "ks", 0.6f, "how much light the beads send back"),
    real(&Params::sharpness, "sharpness", 200, "the larger, the narrower the returned beam").minimum(1),
    integer(&Params::stripes, "stripes", 0, "stripes of beads along v; 0: beads everywhere").range(0, 100));

constexpr candela::Property k_properties[] = {{"reciprocal"}, {"isotropic"}};

}  // namespace

CANDELA_PLUGIN(reflection, Retroreflector, k_fields,
               {.title = "Retroreflector",
                .summary = "Glass beads that send light back to where it came from, as on road signs.",
                .formula = "I_a = ka C_o I_ambient\nI_d = kd C_o I_L N.L\nI_s = ks I_L N.L (V.L)^sharpness",
                .reference = "none: a lobe around the direction of the light",
                .properties = k_properties})
