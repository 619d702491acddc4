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

/// What a model's kernel reads of Surface beyond normal, to_observer and color: joined by |. Nothing else is
/// filled.
enum SurfaceReads : unsigned { reads_no_more = 0, reads_tangent = 1, reads_position = 2, reads_uv = 4 };
constexpr SurfaceReads operator|(SurfaceReads a, SurfaceReads b) {
    return static_cast<SurfaceReads>(static_cast<unsigned>(a) | static_cast<unsigned>(b));
}

template <SurfaceReads reads>
CANDELA_KERNEL_INLINE kernel::Surface surface_at(const SurfaceBatch& batch, vec3 color, std::size_t i) {
    kernel::Surface s;
    s.normal = load(batch.normal, i);
    s.to_observer = load(batch.to_observer, i);
    s.tangent = vec3(0.0f);
    if constexpr ((reads & reads_tangent) != 0) s.tangent = load(batch.tangent, i);
    s.color = color;
    s.position = vec3(0.0f);
    if constexpr ((reads & reads_position) != 0) s.position = load(batch.position, i);
    s.uv = vec2(0.0f);
    if constexpr ((reads & reads_uv) != 0) s.uv = vec2(batch.uv.x[i], batch.uv.y[i]);
    return s;
}

template <class Material, auto reflect, SurfaceReads reads>
struct ReflectLoop {
    CANDELA_BATCH_LOOP static void run(Material material, SurfaceBatch surface, LightingBatch light,
                                       ReflectedBatch reflected) {
        const vec3 color = kernel_vector(surface.color);
        const std::size_t count = surface.count;
        CANDELA_VECTORIZE_CHAIN
        for (std::size_t i = 0; i < count; ++i) {
            const kernel::Surface s = surface_at<reads>(surface, color, i);
            const kernel::Reflected r = call<reflect>(material, s, load(light.to_light, i));
            add_product(reflected.diffuse, i, r.diffuse, load(light.diffuse, i));
            add_product(reflected.specular, i, r.specular, load(light.specular, i));
        }
    }
};

template <class Material, auto reflect_ambient, SurfaceReads reads>
struct ReflectAmbientLoop {
    CANDELA_BATCH_LOOP static void run(Material material, SurfaceBatch surface, ConstVec3Span ambient,
                                       ReflectedBatch reflected) {
        const vec3 color = kernel_vector(surface.color);
        const std::size_t count = surface.count;
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) {
            const vec3 k = call<reflect_ambient>(material, surface_at<reads>(surface, color, i));
            add_product(reflected.ambient, i, k, load(ambient, i));
        }
    }
};

template <class Material, auto reflect_, auto reflect_ambient_, SurfaceReads reads = reads_no_more>
class KernelReflection : public ReflectionModel {
  public:
    static constexpr KernelFunction k_kernel_functions[] = {
        kernel_function<Material, reflect_>("reflect"),
        kernel_function<Material, reflect_ambient_>("reflect_ambient")};

    explicit KernelReflection(const Material& material) : material_(material) {}

    bool needs_tangent() const noexcept override { return (reads & reads_tangent) != 0; }
    bool needs_uv() const noexcept override { return (reads & reads_uv) != 0; }
    bool needs_position() const noexcept override { return (reads & reads_position) != 0; }

    void reflect(const SurfaceBatch& surface, const LightingBatch& light,
                 const ReflectedBatch& reflected) const override {
        multiversion<ReflectLoop<Material, reflect_, reads>>(material_, surface, light, reflected);
    }

    void reflect_ambient(const SurfaceBatch& surface, const ConstVec3Span& ambient,
                         const ReflectedBatch& reflected) const override {
        multiversion<ReflectAmbientLoop<Material, reflect_ambient_, reads>>(material_, surface, ambient,
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

/// The same for a model that reads more of Surface: `reads` is, for example, reads_position | reads_uv.
#define CANDELA_REFLECTION_PLUGIN_READING(reads, prefix, Material, fields, ...)                \
    CANDELA_KERNEL_PLUGIN(                                                                     \
        reflection,                                                                            \
        (candela::sdk::KernelReflection<CANDELA_KERNEL_CONSTANTS(prefix, Material),            \
                                        &candela::kernel::prefix##_reflect,                    \
                                        &candela::kernel::prefix##_reflect_ambient, (reads)>), \
        prefix, Material, fields, __VA_ARGS__)

/// The same for a model that reads Surface::tangent.
#define CANDELA_ANISOTROPIC_REFLECTION_PLUGIN(prefix, Material, fields, ...) \
    CANDELA_REFLECTION_PLUGIN_READING(candela::sdk::reads_tangent, prefix, Material, fields, __VA_ARGS__)
