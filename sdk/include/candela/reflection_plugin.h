// A reflection model from two kernel functions:
//
//     Reflected x_reflect(XMaterial m, Surface s, vec3 to_light)
//     vec3 x_reflect_ambient(XMaterial m, Surface s)
//
// They return the factors for a light's intensities and for the ambient intensity.
#pragma once

#include "candela/multiversion.h"
#include "candela/plugin.h"
#include "candela/reflection.h"

namespace candela::sdk {

// The parameters of the classic models (CA Table 1).

template <class M>
constexpr Field<M> ambient_coefficient(vec3 M::* member) {
    return coefficient(member, "ka", 0.1f, "how much ambient light is reflected");
}
template <class M>
constexpr Field<M> diffuse_coefficient(vec3 M::* member) {
    return coefficient(member, "kd", 0.7f, "how much light is reflected diffusely");
}
template <class M>
constexpr Field<M> specular_coefficient(vec3 M::* member) {
    return coefficient(member, "ks", 0.3f, "how much light is reflected in the highlight");
}
template <class M>
constexpr Field<M> shininess(float M::* member) {
    return real(member, "shininess", 32, "the larger, the smaller and sharper the highlight").minimum(0);
}
/// RE ties the two by k_s + k_d = 1.
inline constexpr RelationSpec k_diffuse_and_specular[] = {
    {RelationType::sum_at_most_one, "kd", "ks", true, "the surface sends out more light than it receives"}};

enum class Tangent : bool { unused, needed };

template <Tangent tangent>
CANDELA_KERNEL_INLINE kernel::Surface surface_at(const SurfaceBatch& batch, vec3 color, std::size_t i) {
    kernel::Surface s;
    s.normal = load(batch.normal, i);
    s.to_observer = load(batch.to_observer, i);
    s.tangent = vec3(0.0f);
    if constexpr (tangent == Tangent::needed) s.tangent = load(batch.tangent, i);
    s.color = color;
    return s;
}

template <class Material, auto reflect, Tangent tangent>
struct ReflectLoop {
    CANDELA_BATCH_LOOP static void run(Material material, SurfaceBatch surface, LightingBatch light,
                                       ReflectedBatch reflected) {
        const vec3 color = kernel_vector(surface.color);
        const std::size_t count = surface.count;
        CANDELA_VECTORIZE_CHAIN
        for (std::size_t i = 0; i < count; ++i) {
            const kernel::Surface s = surface_at<tangent>(surface, color, i);
            const kernel::Reflected r = call<reflect>(material, s, load(light.to_light, i));
            add_product(reflected.diffuse, i, r.diffuse, load(light.diffuse, i));
            add_product(reflected.specular, i, r.specular, load(light.specular, i));
        }
    }
};

template <class Material, auto reflect_ambient, Tangent tangent>
struct ReflectAmbientLoop {
    CANDELA_BATCH_LOOP static void run(Material material, SurfaceBatch surface, ConstVec3Span ambient,
                                       ReflectedBatch reflected) {
        const vec3 color = kernel_vector(surface.color);
        const std::size_t count = surface.count;
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) {
            const vec3 k = call<reflect_ambient>(material, surface_at<tangent>(surface, color, i));
            add_product(reflected.ambient, i, k, load(ambient, i));
        }
    }
};

template <class Material, auto reflect_, auto reflect_ambient_, Tangent tangent = Tangent::unused>
class KernelReflection final : public ReflectionModel {
  public:
    static constexpr KernelFunction k_kernel_functions[] = {
        kernel_function<Material, reflect_>("reflect"),
        kernel_function<Material, reflect_ambient_>("reflect_ambient")};

    explicit KernelReflection(const Material& material) : material_(material) {}

    bool needs_tangent() const noexcept override { return tangent == Tangent::needed; }

    void reflect(const SurfaceBatch& surface, const LightingBatch& light,
                 const ReflectedBatch& reflected) const override {
        multiversion<ReflectLoop<Material, reflect_, tangent>>(material_, surface, light, reflected);
    }

    void reflect_ambient(const SurfaceBatch& surface, const ConstVec3Span& ambient,
                         const ReflectedBatch& reflected) const override {
        multiversion<ReflectAmbientLoop<Material, reflect_ambient_, tangent>>(material_, surface, ambient,
                                                                              reflected);
    }

  private:
    Material material_;
};

}  // namespace candela::sdk

/// A plugin from the kernel functions `prefix_reflect` and `prefix_reflect_ambient`; `Material`, or what
/// `prefix_prepare` makes of it, is their first argument.
#define CANDELA_REFLECTION_PLUGIN(prefix, Material, fields, ...)                                        \
    CANDELA_KERNEL_PLUGIN(reflection,                                                                   \
                          (candela::sdk::KernelReflection<CANDELA_KERNEL_CONSTANTS(prefix, Material),   \
                                                          &candela::kernel::prefix##_reflect,           \
                                                          &candela::kernel::prefix##_reflect_ambient>), \
                          prefix, Material, fields, __VA_ARGS__)

/// The same for a model that reads Surface::tangent.
#define CANDELA_ANISOTROPIC_REFLECTION_PLUGIN(prefix, Material, fields, ...)                \
    CANDELA_KERNEL_PLUGIN(                                                                  \
        reflection,                                                                         \
        (candela::sdk::KernelReflection<                                                    \
            CANDELA_KERNEL_CONSTANTS(prefix, Material), &candela::kernel::prefix##_reflect, \
            &candela::kernel::prefix##_reflect_ambient, candela::sdk::Tangent::needed>),    \
        prefix, Material, fields, __VA_ARGS__)
