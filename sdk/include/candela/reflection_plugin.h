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

template <SurfaceReads reads, bool has_observer = true>
CANDELA_KERNEL_INLINE kernel::Surface surface_at(const SurfaceBatch& batch, std::size_t i) {
    kernel::Surface s;
    s.normal = load(batch.normal, i);
    s.to_observer = vec3(0.0f);
    if constexpr (has_observer) s.to_observer = load(batch.to_observer, i);
    s.tangent = vec3(0.0f);
    if constexpr ((reads & reads_tangent) != 0) s.tangent = load(batch.tangent, i);
    s.color = load(batch.point_color, i);
    s.position = vec3(0.0f);
    if constexpr ((reads & reads_position) != 0) s.position = load(batch.position, i);
    s.uv = vec2(0.0f);
    if constexpr ((reads & reads_uv) != 0) s.uv = vec2(batch.uv.x[i], batch.uv.y[i]);
    return s;
}

/// A range of the SurfaceBatch's points, from `first` on.
CANDELA_KERNEL_INLINE SurfaceBatch part_of(const SurfaceBatch& surface, std::size_t first,
                                           std::size_t count) {
    SurfaceBatch part = surface;
    part.count = count;
    for (ConstVec3Span* const span :
         {&part.normal, &part.to_observer, &part.tangent, &part.position, &part.point_color}) {
        if (*span) *span = span->from(first);
    }
    if (part.uv) part.uv = part.uv.from(first);
    return part;
}

/// How many points pass through a loop in one go: few enough to stay in the first-level cache.
inline constexpr std::size_t k_pass_size = 64;

struct PassVectors {
    alignas(64) float x[k_pass_size], y[k_pass_size], z[k_pass_size];
};

/// A batch, pass by pass, in which each point has a colour: its own, or the one that all of them have.
class SurfacePasses {
  public:
    // Not within the loops over points, whose vectorisation is watched.
    explicit SurfacePasses(const SurfaceBatch& surface) : surface_(surface) {
        if (surface.point_color) return;
        const vec3 color = kernel_vector(surface.color);
        const std::size_t count = surface.count < k_pass_size ? surface.count : k_pass_size;
        for (std::size_t i = 0; i < count; ++i) store(color_, i, color);
    }
    CANDELA_KERNEL_INLINE std::size_t count() const { return surface_.count; }
    CANDELA_KERNEL_INLINE SurfaceBatch from(std::size_t first) const {
        const std::size_t rest = surface_.count - first;
        SurfaceBatch pass = part_of(surface_, first, rest < k_pass_size ? rest : k_pass_size);
        if (!pass.point_color) pass.point_color = {color_.x, color_.y, color_.z};
        return pass;
    }

  private:
    SurfaceBatch surface_;
    PassVectors color_;
};

template <class Material, auto reflect, SurfaceReads reads>
struct ReflectLoop {
    CANDELA_KERNEL_INLINE static void add(const Material& material, const SurfaceBatch& surface,
                                          ConstVec3Span to_light, ConstVec3Span diffuse,
                                          ConstVec3Span specular, Vec3Span to_diffuse, Vec3Span to_specular) {
        const std::size_t count = surface.count;
        CANDELA_VECTORIZE_CHAIN
        for (std::size_t i = 0; i < count; ++i) {
            const kernel::Surface s = surface_at<reads>(surface, i);
            const kernel::Reflected r = call<reflect>(material, s, load(to_light, i));
            add_product(to_diffuse, i, r.diffuse, load(diffuse, i));
            add_product(to_specular, i, r.specular, load(specular, i));
        }
    }

    CANDELA_BATCH_LOOP static void run(Material material, const SurfacePasses* passes, LightingBatch light,
                                       ReflectedBatch reflected) {
        for (std::size_t first = 0; first < passes->count(); first += k_pass_size)
            add(material, passes->from(first), light.to_light.from(first), light.diffuse.from(first),
                light.specular.from(first), reflected.diffuse.from(first), reflected.specular.from(first));
    }
};

template <class Material, auto reflect_ambient, SurfaceReads reads>
struct ReflectAmbientLoop {
    CANDELA_KERNEL_INLINE static void add(const Material& material, const SurfaceBatch& surface,
                                          ConstVec3Span ambient, Vec3Span to_ambient) {
        const std::size_t count = surface.count;
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) {
            const vec3 k = call<reflect_ambient>(material, surface_at<reads>(surface, i));
            add_product(to_ambient, i, k, load(ambient, i));
        }
    }

    CANDELA_BATCH_LOOP static void run(Material material, const SurfacePasses* passes, ConstVec3Span ambient,
                                       ReflectedBatch reflected) {
        for (std::size_t first = 0; first < passes->count(); first += k_pass_size)
            add(material, passes->from(first), ambient.from(first), reflected.ambient.from(first));
    }
};

/// Points on their way through one light after another.
struct PunctualBatch {
    PassVectors to_observer, to_light;
    alignas(64) float attenuation[k_pass_size];
};

/// The way to a light, and its attenuation. At the light itself, L is N.
CANDELA_KERNEL_INLINE void look_at(PunctualLight light, std::size_t count, const ConstVec3Span& position,
                                   const ConstVec3Span& normal, PunctualBatch& batch) {
    const vec3 source = kernel_vector(light.position);
    const bool is_attenuated = light.linear != 0 || light.quadratic != 0;
    CANDELA_VECTORIZE_CHAIN
    for (std::size_t i = 0; i < count; ++i) {
        const vec3 to_source = source - light.w * load(position, i);
        const float square = dot(to_source, to_source);
        const float inverse = kernel::inversesqrt(kernel::max(square, 1.0e-36f));
        store(batch.to_light, i, square > 1.0e-36f ? to_source * inverse : load(normal, i));
        batch.attenuation[i] = kernel::max(square * inverse, 1.0e-4f);
    }
    const float constant = 1.0f / light.constant;
    CANDELA_VECTORIZE
    for (std::size_t i = 0; i < count; ++i) {
        const float r = batch.attenuation[i];
        batch.attenuation[i] =
            is_attenuated ? 1.0f / (light.constant + r * (light.linear + r * light.quadratic)) : constant;
    }
    if (!light.has_cone) return;
    const vec3 axis = kernel_vector(light.axis);
    CANDELA_VECTORIZE
    for (std::size_t i = 0; i < count; ++i) {
        const float cosine = -dot(load(batch.to_light, i), axis);
        const float t = kernel::clamp((cosine - light.cos_outer) * light.cone_scale, 0.0f, 1.0f);
        batch.attenuation[i] *= light.is_smooth ? t * t * (3.0f - 2.0f * t) : t;
    }
}

template <class Material, auto reflect, auto reflect_ambient, SurfaceReads reads>
struct ReflectPunctualLoop {
    CANDELA_KERNEL_INLINE static kernel::Surface point(const SurfaceBatch& surface,
                                                       const PunctualBatch& batch, std::size_t i) {
        kernel::Surface s = surface_at<reads, false>(surface, i);
        s.to_observer = load(batch.to_observer, i);
        return s;
    }

    CANDELA_KERNEL_INLINE static void add_lights(const Material& material, const SurfaceBatch& surface,
                                                 const PunctualLighting& lighting, Vec3Span intensity) {
        const vec3 ambient = kernel_vector(lighting.ambient), observer = kernel_vector(lighting.observer);
        const float w = lighting.w;
        const std::size_t count = surface.count;
        PunctualBatch batch;
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) {
            store(batch.to_observer, i, kernel::normalize(observer - w * load(surface.position, i)));
            store(intensity, i, call<reflect_ambient>(material, point(surface, batch, i)) * ambient);
        }
        for (const PunctualLight& light : lighting.lights) {
            look_at(light, count, surface.position, surface.normal, batch);
            const vec3 diffuse = kernel_vector(light.diffuse), specular = kernel_vector(light.specular);
            CANDELA_VECTORIZE_CHAIN
            for (std::size_t i = 0; i < count; ++i) {
                const kernel::Reflected r =
                    call<reflect>(material, point(surface, batch, i), load(batch.to_light, i));
                add_product(intensity, i, r.diffuse * diffuse + r.specular * specular,
                            vec3(batch.attenuation[i]));
            }
        }
    }

    CANDELA_BATCH_LOOP static void run(Material material, const SurfacePasses* passes,
                                       PunctualLighting lighting, Vec3Span intensity) {
        for (std::size_t first = 0; first < passes->count(); first += k_pass_size)
            add_lights(material, passes->from(first), lighting, intensity.from(first));
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
        const SurfacePasses passes(surface);
        const SurfacePasses* const all = &passes;
        multiversion<ReflectLoop<Material, reflect_, reads>>(material_, all, light, reflected);
    }

    void reflect_ambient(const SurfaceBatch& surface, const ConstVec3Span& ambient,
                         const ReflectedBatch& reflected) const override {
        const SurfacePasses passes(surface);
        const SurfacePasses* const all = &passes;
        multiversion<ReflectAmbientLoop<Material, reflect_ambient_, reads>>(material_, all, ambient,
                                                                            reflected);
    }

    bool reflect_punctual(const SurfaceBatch& surface, const PunctualLighting& lighting,
                          const Vec3Span& intensity) const override {
        const SurfacePasses passes(surface);
        const SurfacePasses* const all = &passes;
        multiversion<ReflectPunctualLoop<Material, reflect_, reflect_ambient_, reads>>(material_, all,
                                                                                       lighting, intensity);
        return true;
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
