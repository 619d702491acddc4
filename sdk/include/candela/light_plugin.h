// Makes a light from kernel functions:
//
//     // the light of a source with a single direction
//     Incident x_illuminate(XLight light, Receiver r)
//     // the light of an ambient source
//     vec3 x_illuminate_ambient(XLight light, Receiver r)
//
// A source modelled by several samples, whose light adds up:
//
//     // the number of samples, at least 1
//     int x_sample_count(XLight light)
//     // the light of sample `index`, 0 <= index < x_sample_count(light)
//     Incident x_illuminate(XLight light, Receiver r, int index)
//
// Reflection models evaluate a light that can describe itself as data in their own loop, which is faster with
// many lights. Such a light has one of two C++ functions in the namespace of XLight, where they are found by
// argument-dependent lookup:
//
//     // sample `index`; 0 if the light has only one
//     PunctualLight punctual(const XLight& light, int index)
//     // an ambient light that is the same everywhere
//     vec3 uniform_ambient(const XLight& light)
//
// The conformance kit checks them against the kernel functions.
#pragma once

#include "candela/kernel/simd_dispatch.h"
#include "candela/light.h"
#include "candela/plugin.h"
#include "candela/punctual.h"

namespace candela::sdk {

// The parameters that the shipped lights share.
template <class P>
constexpr Field<P> light_color(vec3 P::* member) {
    return color(member, "color", vec3(255.0f), "colour of the light");
}
template <class P>
constexpr Field<P> light_intensity(float P::* member, const char* meaning) {
    return real(member, "intensity", 1, meaning).minimum(0);
}

/// The choices of the kernel function distance_attenuation().
inline constexpr const char* k_attenuations[] = {"inverse-square", "offset-linear", "none"};
template <class P>
constexpr Field<P> attenuation(std::int32_t P::* member) {
    return choice(member, "attenuation", k_attenuations, "attenuation with distance r");
}
template <class P>
constexpr Field<P> attenuation_offset(float P::* member) {
    return real(member, "attenuation_offset", 0.01f, "k of offset-linear attenuation 1/(r + k)")
        .minimum(0)
        .unit("m");
}

/// Kernel function point_source() as data.
inline PunctualLight punctual_source(vec3 position, vec3 color, float intensity, int law, float offset) {
    PunctualLight light;
    light.position = {position.x, position.y, position.z};
    light.diffuse = light.specular = {color.x * intensity, color.y * intensity, color.z * intensity};
    light.constant = law == 1 ? offset : (law == 0 ? 0.0f : 1.0f);
    light.linear = law == 1 ? 1.0f : 0.0f;
    light.quadratic = law == 0 ? 1.0f : 0.0f;
    return light;
}

CANDELA_KERNEL_INLINE kernel::Receiver receiver_at(const ReceiverBatch& batch, std::size_t i) {
    return {load(batch.position, i), load(batch.normal, i)};
}

template <class Params, auto illuminate>
struct IlluminateLoop {
    /// Passes `index`, the number of the sample, if the kernel function takes it.
    template <class... Index>
    CANDELA_BATCH_LOOP static void run(Params light, ReceiverBatch receivers, IncidentBatch incident,
                                       Index... index) {
        const std::size_t count = receivers.count;
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) {
            const kernel::Incident sent = call<illuminate>(light, receiver_at(receivers, i), index...);
            store(incident.to_light, i, sent.to_light);
            store(incident.diffuse, i, sent.diffuse);
            store(incident.specular, i, sent.specular);
        }
    }
};

template <class Params, auto illuminate_ambient>
struct IlluminateAmbientLoop {
    CANDELA_BATCH_LOOP static void run(Params light, ReceiverBatch receivers, Vec3Span ambient) {
        const std::size_t count = receivers.count;
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) {
            store(ambient, i, call<illuminate_ambient>(light, receiver_at(receivers, i)));
        }
    }
};

template <class Params>
bool described(const Params& params, int sample, PunctualLight& light) {
    if constexpr (requires { punctual(params, sample); }) {
        light = punctual(params, sample);
        return true;
    } else {
        return false;
    }
}

template <class Params, auto illuminate_>
class KernelLight : public Light {
  public:
    static constexpr KernelFunction k_kernel_functions[] = {
        kernel_function<Params, illuminate_>("illuminate")};

    explicit KernelLight(const Params& params) : params_(params) {}
    int sample_count() const noexcept override { return 1; }
    bool has_ambient() const noexcept override { return false; }
    void illuminate(int, const ReceiverBatch& receivers, const IncidentBatch& incident) const override {
        multiversion<IlluminateLoop<Params, illuminate_>>(params_, receivers, incident);
    }
    bool as_punctual(int sample, PunctualLight& light) const override {
        return described(params_, sample, light);
    }

  private:
    Params params_;
};

template <class Params, auto illuminate_, auto sample_count_>
class KernelSampledLight : public Light {
  public:
    static constexpr KernelFunction k_kernel_functions[] = {
        kernel_function<Params, illuminate_>("illuminate"),
        kernel_function<Params, sample_count_>("sample_count")};

    explicit KernelSampledLight(const Params& params) : params_(params) {}
    int sample_count() const noexcept override { return call<sample_count_>(params_); }
    bool has_ambient() const noexcept override { return false; }
    void illuminate(int sample, const ReceiverBatch& receivers,
                    const IncidentBatch& incident) const override {
        multiversion<IlluminateLoop<Params, illuminate_>>(params_, receivers, incident, sample);
    }
    bool as_punctual(int sample, PunctualLight& light) const override {
        return described(params_, sample, light);
    }

  private:
    Params params_;
};

template <class Params, auto illuminate_ambient_>
class KernelAmbientLight : public Light {
  public:
    static constexpr KernelFunction k_kernel_functions[] = {
        kernel_function<Params, illuminate_ambient_>("illuminate_ambient")};

    explicit KernelAmbientLight(const Params& params) : params_(params) {}
    int sample_count() const noexcept override { return 0; }
    bool has_ambient() const noexcept override { return true; }
    void illuminate_ambient(const ReceiverBatch& receivers, const Vec3Span& ambient) const override {
        multiversion<IlluminateAmbientLoop<Params, illuminate_ambient_>>(params_, receivers, ambient);
    }
    bool as_ambient(Rgb& ambient) const override {
        if constexpr (requires { uniform_ambient(params_); }) {
            const vec3 same = uniform_ambient(params_);
            ambient = {same.x, same.y, same.z};
            return true;
        } else {
            return false;
        }
    }

  private:
    Params params_;
};

}  // namespace candela::sdk

/// A plugin from the kernel function `prefix_illuminate`; `Params` is its first argument.
#define CANDELA_LIGHT_PLUGIN(prefix, Params, fields, ...)                                      \
    CANDELA_KERNEL_PLUGIN(light,                                                               \
                          (candela::sdk::KernelLight<CANDELA_KERNEL_CONSTANTS(prefix, Params), \
                                                     &candela::kernel::prefix##_illuminate>),  \
                          prefix, Params, fields, __VA_ARGS__)

/// A plugin from the kernel functions `prefix_illuminate` and `prefix_sample_count` of a source with several
/// samples; `Params` is their first argument.
#define CANDELA_SAMPLED_LIGHT_PLUGIN(prefix, Params, fields, ...)                                      \
    CANDELA_KERNEL_PLUGIN(light,                                                                       \
                          (candela::sdk::KernelSampledLight<CANDELA_KERNEL_CONSTANTS(prefix, Params),  \
                                                            &candela::kernel::prefix##_illuminate,     \
                                                            &candela::kernel::prefix##_sample_count>), \
                          prefix, Params, fields, __VA_ARGS__)

/// A plugin from the kernel function `prefix_illuminate_ambient`; `Params` is its first argument.
#define CANDELA_AMBIENT_LIGHT_PLUGIN(prefix, Params, fields, ...)                                            \
    CANDELA_KERNEL_PLUGIN(light,                                                                             \
                          (candela::sdk::KernelAmbientLight<CANDELA_KERNEL_CONSTANTS(prefix, Params),        \
                                                            &candela::kernel::prefix##_illuminate_ambient>), \
                          prefix, Params, fields, __VA_ARGS__)
