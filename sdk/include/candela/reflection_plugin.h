// Makes a reflection model from two kernel functions:
//
//     Reflected x_reflect(XMaterial m, Surface s, vec3 to_light)
//     vec3 x_reflect_ambient(XMaterial m, Surface s)
//
// They return the factors for a light's intensities and for the ambient intensity. A model that mirrors light
// from everywhere, such as a panorama, also says how wide its highlight is, as alpha of a GGX distribution:
//
//     float x_highlight_width(XMaterial m)
//
// A model in a .kernel file
// is a KernelReflection; so is a model whose parameters need C++, which ends with CANDELA_KERNEL_PLUGIN.
#pragma once

#include <algorithm>

#include "candela/extensions.h"
#include "candela/kernel/simd_dispatch.h"
#include "candela/materials.h"
#include "candela/plugin.h"
#include "candela/punctual.h"
#include "candela/reflection_model.h"

namespace candela::sdk {

/// The members of Surface that a model's kernel reads in addition to normal, to_observer and color, joined by
/// |. No others are filled.
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

struct PassVectors {
    alignas(64) float x[k_pass_size], y[k_pass_size], z[k_pass_size];

    CANDELA_KERNEL_INLINE Vec3Span span() { return {x, y, z}; }
};

/// A batch, split into passes, in which each point has a colour: its own or the common one. Each pass has
/// arrays of k_pass_size elements; if the batch does not fill its last pass, its last point is repeated.
class SurfacePasses {
  public:
    // Not inside the loops over points, whose vectorisation is verified.
    explicit SurfacePasses(const SurfaceBatch& surface)
        : surface_(surface), whole_(surface.count / k_pass_size * k_pass_size) {
        if (!surface.point_color) {
            const vec3 color = kernel_vector(surface.color);
            for (std::size_t i = 0; i < k_pass_size; ++i) store(color_, i, color);
        }
        if (whole_ == surface.count) return;
        rest_ = part_of(surface, whole_, surface.count - whole_);
        fill(rest_.normal, normal_);
        fill(rest_.to_observer, to_observer_);
        fill(rest_.tangent, tangent_);
        fill(rest_.position, position_);
        fill(rest_.point_color, color_);
        if (rest_.uv) {
            for (std::size_t i = 0; i < k_pass_size; ++i) {
                u_[i] = rest_.uv.x[source(i)];
                v_[i] = rest_.uv.y[source(i)];
            }
            rest_.uv = {u_, v_};
        }
    }
    SurfacePasses(const SurfacePasses&) = delete;
    SurfacePasses& operator=(const SurfacePasses&) = delete;

    CANDELA_KERNEL_INLINE std::size_t count() const { return surface_.count; }
    /// The number of points in full passes.
    CANDELA_KERNEL_INLINE std::size_t whole() const { return whole_; }
    CANDELA_KERNEL_INLINE SurfaceBatch from(std::size_t first) const {
        SurfaceBatch pass = first < whole_ ? part_of(surface_, first, k_pass_size) : rest_;
        if (!pass.point_color) pass.point_color = {color_.x, color_.y, color_.z};
        return pass;
    }

  private:
    std::size_t source(std::size_t i) const { return i < rest_.count ? i : rest_.count - 1; }
    void fill(ConstVec3Span& span, PassVectors& filled) const {
        if (!span) return;
        for (std::size_t i = 0; i < k_pass_size; ++i) store(filled, i, load(span, source(i)));
        span = {filled.x, filled.y, filled.z};
    }

    SurfaceBatch surface_;
    std::size_t whole_;
    SurfaceBatch rest_;
    PassVectors normal_, to_observer_, tangent_, position_, color_;
    float u_[k_pass_size], v_[k_pass_size];
};

/// `Materials`: UniformMaterial or VaryingMaterials.
template <class Materials, auto reflect, SurfaceReads reads>
struct ReflectLoop {
    CANDELA_KERNEL_INLINE static void add(const auto& materials, const SurfaceBatch& surface,
                                          ConstVec3Span to_light, ConstVec3Span diffuse,
                                          ConstVec3Span specular, Vec3Span to_diffuse, Vec3Span to_specular) {
        const std::size_t count = surface.count;
        CANDELA_VECTORIZE_CHAIN
        for (std::size_t i = 0; i < count; ++i) {
            const kernel::Surface s = surface_at<reads>(surface, i);
            const kernel::Reflected r = call<reflect>(materials[i], s, load(to_light, i));
            add_product(to_diffuse, i, r.diffuse, load(diffuse, i));
            add_product(to_specular, i, r.specular, load(specular, i));
        }
    }

    CANDELA_BATCH_LOOP static void run(Materials materials, const SurfacePasses* passes, LightingBatch light,
                                       ReflectedBatch reflected) {
        typename Materials::Pass pass;
        for (std::size_t first = 0; first < passes->count(); first += k_pass_size)
            add(materials.pass(first, pass), passes->from(first), light.to_light.from(first),
                light.diffuse.from(first), light.specular.from(first), reflected.diffuse.from(first),
                reflected.specular.from(first));
    }
};

template <class Materials, auto reflect_ambient, SurfaceReads reads>
struct ReflectAmbientLoop {
    CANDELA_KERNEL_INLINE static void add(const auto& materials, const SurfaceBatch& surface,
                                          ConstVec3Span ambient, Vec3Span to_ambient) {
        const std::size_t count = surface.count;
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) {
            const vec3 k = call<reflect_ambient>(materials[i], surface_at<reads>(surface, i));
            add_product(to_ambient, i, k, load(ambient, i));
        }
    }

    CANDELA_BATCH_LOOP static void run(Materials materials, const SurfacePasses* passes,
                                       ConstVec3Span ambient, ReflectedBatch reflected) {
        typename Materials::Pass pass;
        for (std::size_t first = 0; first < passes->count(); first += k_pass_size)
            add(materials.pass(first, pass), passes->from(first), ambient.from(first),
                reflected.ambient.from(first));
    }
};

/// Points that are lit by one light after another.
struct PunctualBatch {
    PassVectors to_observer, to_light;
    alignas(64) float attenuation[k_pass_size];
};

/// The positions of a pass multiplied by w: what is infinitely far away looks the same from everywhere.
CANDELA_KERNEL_INLINE ConstVec3Span seen_from(const ConstVec3Span& position, float w) {
    alignas(64) static constexpr float k_zero[k_pass_size] = {};
    return w != 0 ? position : ConstVec3Span{k_zero, k_zero, k_zero};
}

/// Multiplies the attenuation of the points from `first` on by the fraction of the light that reaches them.
CANDELA_KERNEL_INLINE void shadow(const float* visibility, std::size_t first, std::size_t count,
                                  PunctualBatch& batch) {
    if (count >= first + k_pass_size) {
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < k_pass_size; ++i) batch.attenuation[i] *= visibility[first + i];
        return;
    }
    for (std::size_t i = first; i < count; ++i) batch.attenuation[i - first] *= visibility[i];
}

/// The direction to a light, and its attenuation. At the light itself, L is N.
/// `position`: see seen_from().
CANDELA_KERNEL_INLINE void look_at(PunctualLight light, const ConstVec3Span& position,
                                   const ConstVec3Span& normal, PunctualBatch& batch) {
    const vec3 source = kernel_vector(light.position);
    const bool is_attenuated = light.linear != 0 || light.quadratic != 0;
    CANDELA_VECTORIZE_FOUR
    for (std::size_t i = 0; i < k_pass_size; ++i) {
        const vec3 to_source = source - load(position, i);
        const float square = dot(to_source, to_source);
        const float inverse = kernel::inversesqrt(kernel::max(square, 1.0e-36f));
        store(batch.to_light, i, square > 1.0e-36f ? to_source * inverse : load(normal, i));
        batch.attenuation[i] = kernel::max(square * inverse, 1.0e-4f);
    }
    const float constant = 1.0f / light.constant;
    CANDELA_VECTORIZE
    for (float& attenuation : batch.attenuation) {
        const float r = attenuation;
        attenuation =
            is_attenuated ? 1.0f / (light.constant + r * (light.linear + r * light.quadratic)) : constant;
    }
    if (!light.has_cone) return;
    const vec3 axis = kernel_vector(light.axis);
    CANDELA_VECTORIZE
    for (std::size_t i = 0; i < k_pass_size; ++i) {
        const float cosine = -dot(load(batch.to_light, i), axis);
        const float t = kernel::clamp((cosine - light.cos_outer) * light.cone_scale, 0.0f, 1.0f);
        batch.attenuation[i] *= light.is_smooth ? t * t * (3.0f - 2.0f * t) : t;
    }
}

template <class Materials, auto reflect, auto reflect_ambient, SurfaceReads reads>
struct ReflectPunctualLoop {
    CANDELA_KERNEL_INLINE static kernel::Surface point(const SurfaceBatch& surface,
                                                       const PunctualBatch& batch, std::size_t i) {
        kernel::Surface s = surface_at<reads, false>(surface, i);
        s.to_observer = load(batch.to_observer, i);
        return s;
    }

    /// The pass begins at point `first` of a batch of `all`.
    CANDELA_KERNEL_INLINE static void add_lights(const auto& materials, const SurfaceBatch& surface,
                                                 const PunctualLighting& lighting, std::size_t first,
                                                 std::size_t all, Vec3Span intensity) {
        const vec3 ambient = kernel_vector(lighting.ambient), observer = kernel_vector(lighting.observer);
        const ConstVec3Span eye_position = seen_from(surface.position, lighting.w);
        PunctualBatch batch;
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < k_pass_size; ++i) {
            store(batch.to_observer, i, kernel::normalize(observer - load(eye_position, i)));
            store(intensity, i, call<reflect_ambient>(materials[i], point(surface, batch, i)) * ambient);
        }
        for (std::size_t k = 0; k < lighting.lights.size(); ++k) {
            const PunctualLight light = lighting.lights[k];
            look_at(light, seen_from(surface.position, light.w), surface.normal, batch);
            if (!lighting.visibility.empty()) shadow(lighting.visibility[k], first, all, batch);
            const vec3 diffuse = kernel_vector(light.diffuse), specular = kernel_vector(light.specular);
            CANDELA_VECTORIZE_FOUR
            for (std::size_t i = 0; i < k_pass_size; ++i) {
                const kernel::Reflected r =
                    call<reflect>(materials[i], point(surface, batch, i), load(batch.to_light, i));
                add_product(intensity, i, r.diffuse * diffuse + r.specular * specular,
                            vec3(batch.attenuation[i]));
            }
        }
    }

    /// `rest`: the reflection of the last pass, if the batch does not fill it.
    CANDELA_BATCH_LOOP static void run(Materials materials, const SurfacePasses* passes,
                                       PunctualLighting lighting, Vec3Span intensity, PassVectors* rest) {
        typename Materials::Pass pass;
        for (std::size_t first = 0; first < passes->count(); first += k_pass_size)
            add_lights(materials.pass(first, pass), passes->from(first), lighting, first, passes->count(),
                       first < passes->whole() ? intensity.from(first) : rest->span());
    }
};

template <class Materials, auto highlight_width>
struct HighlightWidthLoop {
    CANDELA_KERNEL_INLINE static void find(const auto& materials, std::size_t count, float* widths) {
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) widths[i] = call<highlight_width>(materials[i]);
    }

    CANDELA_BATCH_LOOP static void run(Materials materials, std::size_t count, float* widths) {
        typename Materials::Pass pass;
        for (std::size_t first = 0; first < count; first += k_pass_size)
            find(materials.pass(first, pass), std::min(k_pass_size, count - first), widths + first);
    }
};

template <class Model, class Params, class Preparation, const auto& fields>
class VaryingReflection;

template <class Material, auto reflect_, auto reflect_ambient_, SurfaceReads reads = reads_no_more>
class KernelReflection : public ReflectionModel, public AllLightsReflection {
  public:
    static constexpr SurfaceNeeds k_needs{.tangent = (reads & reads_tangent) != 0,
                                          .uv = (reads & reads_uv) != 0,
                                          .position = (reads & reads_position) != 0};
    static constexpr KernelFunction k_kernel_functions[] = {
        kernel_function<Material, reflect_>("reflect"),
        kernel_function<Material, reflect_ambient_>("reflect_ambient")};

    /// The same model, whose parameters may differ from point to point. See VaryingReflection.
    template <class Params, class Preparation, const auto& fields>
    using Varying = VaryingReflection<KernelReflection, Params, Preparation, fields>;

    explicit KernelReflection(const Material& material) : material_{material} {}

    void reflect(const SurfaceBatch& surface, const LightingBatch& light,
                 const ReflectedBatch& reflected) const override {
        reflect_with(material_, surface, light, reflected);
    }

    void reflect_ambient(const SurfaceBatch& surface, const ConstVec3Span& ambient,
                         const ReflectedBatch& reflected) const override {
        reflect_ambient_with(material_, surface, ambient, reflected);
    }

    void reflect_all_lights(const SurfaceBatch& surface, const PunctualLighting& lighting,
                            const Vec3Span& intensity) const override {
        reflect_all_lights_with(material_, surface, lighting, intensity);
    }

  protected:
    template <class Materials>
    static void reflect_with(const Materials& materials, const SurfaceBatch& surface,
                             const LightingBatch& light, const ReflectedBatch& reflected) {
        const SurfacePasses passes(surface);
        const SurfacePasses* const all = &passes;
        multiversion<ReflectLoop<Materials, reflect_, reads>>(materials, all, light, reflected);
    }

    template <class Materials>
    static void reflect_ambient_with(const Materials& materials, const SurfaceBatch& surface,
                                     const ConstVec3Span& ambient, const ReflectedBatch& reflected) {
        const SurfacePasses passes(surface);
        const SurfacePasses* const all = &passes;
        multiversion<ReflectAmbientLoop<Materials, reflect_ambient_, reads>>(materials, all, ambient,
                                                                             reflected);
    }

    template <class Materials>
    static void reflect_all_lights_with(const Materials& materials, const SurfaceBatch& surface,
                                        const PunctualLighting& lighting, const Vec3Span& intensity) {
        const SurfacePasses passes(surface);
        const SurfacePasses* const all = &passes;
        PassVectors rest;
        PassVectors* const to_rest = &rest;
        multiversion<ReflectPunctualLoop<Materials, reflect_, reflect_ambient_, reads>>(
            materials, all, lighting, intensity, to_rest);
        for (std::size_t i = passes.whole(); i < surface.count; ++i)
            store(intensity, i, load(rest, i - passes.whole()));
    }

    const UniformMaterial<Material>& material() const noexcept { return material_; }

  private:
    UniformMaterial<Material> material_;
};

/// `Model`, a KernelReflection, with its parameters: where a batch has varying ones, it evaluates the kernel
/// with those of each point.
template <class Model, class Params, class Preparation, const auto& fields>
class VaryingReflection : public Model {
  public:
    static constexpr SurfaceNeeds k_needs = [] {
        SurfaceNeeds needs = Model::k_needs;
        needs.varying = true;
        return needs;
    }();

    explicit VaryingReflection(const Params& params) : Model(Preparation::run(params)), params_(params) {}

    void reflect(const SurfaceBatch& surface, const LightingBatch& light,
                 const ReflectedBatch& reflected) const override {
        if (surface.varying.empty()) return Model::reflect(surface, light, reflected);
        const std::vector<VaryingNumber> numbers = varying_numbers(fields, surface.varying);
        Model::reflect_with(materials(surface, numbers), surface, light, reflected);
    }

    void reflect_ambient(const SurfaceBatch& surface, const ConstVec3Span& ambient,
                         const ReflectedBatch& reflected) const override {
        if (surface.varying.empty()) return Model::reflect_ambient(surface, ambient, reflected);
        const std::vector<VaryingNumber> numbers = varying_numbers(fields, surface.varying);
        Model::reflect_ambient_with(materials(surface, numbers), surface, ambient, reflected);
    }

    void reflect_all_lights(const SurfaceBatch& surface, const PunctualLighting& lighting,
                            const Vec3Span& intensity) const override {
        if (surface.varying.empty()) return Model::reflect_all_lights(surface, lighting, intensity);
        const std::vector<VaryingNumber> numbers = varying_numbers(fields, surface.varying);
        Model::reflect_all_lights_with(materials(surface, numbers), surface, lighting, intensity);
    }

  protected:
    VaryingMaterials<Params, Preparation> materials(const SurfaceBatch& surface,
                                                    const std::vector<VaryingNumber>& numbers) const {
        return {params_, numbers.data(), numbers.size(), surface.count};
    }

  private:
    Params params_;
};

template <class Model, class Params, class Preparation, const auto& fields>
class VaryingGlossyReflection;

/// A KernelReflection whose kernel also has a function `highlight_width`.
template <class Material, auto reflect_, auto reflect_ambient_, auto highlight_width_,
          SurfaceReads reads = reads_no_more>
class KernelGlossyReflection : public KernelReflection<Material, reflect_, reflect_ambient_, reads>,
                               public GlossyReflection {
    using Reflection = KernelReflection<Material, reflect_, reflect_ambient_, reads>;

  public:
    static constexpr KernelFunction k_kernel_functions[] = {
        kernel_function<Material, reflect_>("reflect"),
        kernel_function<Material, reflect_ambient_>("reflect_ambient"),
        kernel_function<Material, highlight_width_>("highlight_width")};

    template <class Params, class Preparation, const auto& fields>
    using Varying = VaryingGlossyReflection<KernelGlossyReflection, Params, Preparation, fields>;

    explicit KernelGlossyReflection(const Material& material) : Reflection(material) {}

    void highlight_widths(const SurfaceBatch& surface, float* widths) const override {
        find_widths(this->material(), surface.count, widths);
    }

  protected:
    template <class Materials>
    static void find_widths(const Materials& materials, std::size_t count, float* widths) {
        multiversion<HighlightWidthLoop<Materials, highlight_width_>>(materials, count, widths);
    }
};

/// `Model`, a KernelGlossyReflection, like VaryingReflection.
template <class Model, class Params, class Preparation, const auto& fields>
class VaryingGlossyReflection final : public VaryingReflection<Model, Params, Preparation, fields> {
    using Reflection = VaryingReflection<Model, Params, Preparation, fields>;

  public:
    explicit VaryingGlossyReflection(const Params& params) : Reflection(params) {}

    void highlight_widths(const SurfaceBatch& surface, float* widths) const override {
        if (surface.varying.empty()) return Model::highlight_widths(surface, widths);
        const std::vector<VaryingNumber> numbers = varying_numbers(fields, surface.varying);
        Model::find_widths(this->materials(surface, numbers), surface.count, widths);
    }
};

}  // namespace candela::sdk
