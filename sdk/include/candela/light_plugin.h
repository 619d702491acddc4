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
// many lights. Such a light has another kernel function:
//
//     // sample `index`, if the light has several
//     Punctual x_punctual(XLight light)
//     Punctual x_punctual(XLight light, int index)
//
// A light with an extent, whose shadows have penumbras, also says which part of it a sample stands for:
//
//     Extent x_extent(XLight light)
//     Extent x_extent(XLight light, int index)
//
// For shadows, a light that is not data may say how far away it is; without that, it is infinitely far:
//
//     float x_distance(XLight light, Receiver r)
//     float x_distance(XLight light, Receiver r, int index)
//
// A light that comes from everywhere may be seen, as a scene's background:
//
//     // the intensity that arrives from the direction `towards`
//     vec3 x_seen(XLight light, vec3 towards)
//
// A light that reads nothing of the receiver is described without one. The conformance kit checks the
// description against the other functions.
#pragma once

#include <array>
#include <cstddef>
#include <type_traits>

#include "candela/extensions.h"
#include "candela/kernel/simd_dispatch.h"
#include "candela/light.h"
#include "candela/plugin.h"
#include "candela/punctual.h"

namespace candela::sdk {

/// A kernel's description of a light, for reflection models.
inline PunctualLight punctual_light(const kernel::Punctual& given) {
    PunctualLight light;
    light.position = {given.position.x, given.position.y, given.position.z};
    const vec3 sent = given.color * given.intensity;
    light.diffuse = light.specular = {sent.x, sent.y, sent.z};
    light.constant = given.attenuation.x;
    light.linear = given.attenuation.y;
    light.quadratic = given.attenuation.z;
    if (given.falloff == 0) return light;
    light.has_cone = true;
    light.is_smooth = given.falloff == 1;
    light.axis = {given.axis.x, given.axis.y, given.axis.z};
    light.cos_outer = given.cos_outer;
    light.cone_scale = 1.0f / kernel::max(given.cos_inner - given.cos_outer, 1.0e-7f);
    return light;
}

/// The same light with the extent of its sample.
inline PunctualLight with_extent(PunctualLight light, const kernel::Extent& part) {
    light.extent_u = {part.u.x, part.u.y, part.u.z};
    light.extent_v = {part.v.x, part.v.y, part.v.z};
    return light;
}

/// A light whose kernel gives every receiver the same.
inline PunctualLight distant_light(const kernel::Incident& sent) {
    PunctualLight light;
    light.position = {sent.to_light.x, sent.to_light.y, sent.to_light.z};
    light.w = 0;
    light.diffuse = {sent.diffuse.x, sent.diffuse.y, sent.diffuse.z};
    light.specular = {sent.specular.x, sent.specular.y, sent.specular.z};
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

template <class Params, auto distance>
struct DistanceLoop {
    template <class... Index>
    CANDELA_BATCH_LOOP static void run(Params light, ReceiverBatch receivers, float* to, Index... index) {
        const std::size_t count = receivers.count;
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i)
            to[i] = call<distance>(light, receiver_at(receivers, i), index...);
    }
};

/// No function of a kernel.
inline constexpr int k_none = 0;

/// Writes the distance from the receivers, if it is asked for and the kernel knows it.
template <class Params, auto distance, class... Index>
void find_distance(const Params& params, const ReceiverBatch& receivers, const IncidentBatch& incident,
                   Index... index) {
    if constexpr (!std::is_same_v<decltype(distance), int>) {
        if (incident.distance != nullptr)
            multiversion<DistanceLoop<Params, distance>>(params, receivers, incident.distance, index...);
    }
}

/// The kernel functions of a light: `others`, and `distance` unless it is k_none.
template <class Params, auto distance, std::size_t size>
constexpr auto with_distance(const std::array<KernelFunction, size>& others) {
    if constexpr (std::is_same_v<decltype(distance), int>) {
        return others;
    } else {
        std::array<KernelFunction, size + 1> all{};
        for (std::size_t i = 0; i < size; ++i) all[i] = others[i];
        all[size] = kernel_function<Params, distance>("distance");
        return all;
    }
}

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
class LightParams {
  public:
    explicit LightParams(const Params& params) : params_(params) {}

  protected:
    const Params& params() const noexcept { return params_; }

  private:
    Params params_;
};

/// The parameters of a light with samples, which are data if there is a function `punctual`.
template <class Params>
class SampledLightParams : public LightParams<Params> {
  public:
    using LightParams<Params>::LightParams;
};
template <class Params>
    requires requires(const Params& params) { punctual(params, 0); }
class SampledLightParams<Params> : public LightParams<Params>, public PunctualSource {
  public:
    using LightParams<Params>::LightParams;
    PunctualLight as_punctual(int sample) const override { return punctual(this->params(), sample); }
};

/// The parameters of an ambient light, which is data if there is a function `uniform_ambient`.
template <class Params>
class AmbientLightParams : public LightParams<Params> {
  public:
    using LightParams<Params>::LightParams;
};
template <class Params>
    requires requires(const Params& params) { uniform_ambient(params); }
class AmbientLightParams<Params> : public LightParams<Params>, public UniformAmbientSource {
  public:
    using LightParams<Params>::LightParams;
    Rgb as_ambient() const override {
        const vec3 same = uniform_ambient(this->params());
        return {same.x, same.y, same.z};
    }
};

template <class Params, auto seen>
struct SeenLoop {
    CANDELA_BATCH_LOOP static void run(Params light, ConstVec3Span towards, std::size_t count,
                                       Vec3Span intensity) {
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) store(intensity, i, call<seen>(light, load(towards, i)));
    }
};

/// A kernel's light that is also a SkySource.
template <class Light, class Params, auto seen>
class VisibleLight : public Light, public SkySource {
  public:
    explicit VisibleLight(const Params& params) : Light(params) {}
    int sky_columns() const noexcept override { return 1024; }
    void see(std::size_t count, const ConstVec3Span& towards, const Vec3Span& intensity) const override {
        multiversion<SeenLoop<Params, seen>>(this->params(), towards, count, intensity);
    }
};

template <class Params, auto illuminate_, auto distance_ = k_none>
class KernelLight : public Light, public SampledLightParams<Params> {
  public:
    static constexpr auto k_kernel_functions =
        with_distance<Params, distance_>(std::array{kernel_function<Params, illuminate_>("illuminate")});

    explicit KernelLight(const Params& params) : SampledLightParams<Params>(params) {}
    int sample_count() const noexcept override { return 1; }
    void illuminate(int, const ReceiverBatch& receivers, const IncidentBatch& incident) const override {
        multiversion<IlluminateLoop<Params, illuminate_>>(this->params(), receivers, incident);
        find_distance<Params, distance_>(this->params(), receivers, incident);
    }
};

template <class Params, auto illuminate_, auto sample_count_, auto distance_ = k_none>
class KernelSampledLight : public Light, public SampledLightParams<Params> {
  public:
    static constexpr auto k_kernel_functions =
        with_distance<Params, distance_>(std::array{kernel_function<Params, illuminate_>("illuminate"),
                                                    kernel_function<Params, sample_count_>("sample_count")});

    explicit KernelSampledLight(const Params& params) : SampledLightParams<Params>(params) {}
    int sample_count() const noexcept override { return call<sample_count_>(this->params()); }
    void illuminate(int sample, const ReceiverBatch& receivers,
                    const IncidentBatch& incident) const override {
        multiversion<IlluminateLoop<Params, illuminate_>>(this->params(), receivers, incident, sample);
        find_distance<Params, distance_>(this->params(), receivers, incident, sample);
    }
};

template <class Params, auto illuminate_ambient_>
class KernelAmbientLight : public Light, public AmbientLightParams<Params> {
  public:
    static constexpr KernelFunction k_kernel_functions[] = {
        kernel_function<Params, illuminate_ambient_>("illuminate_ambient")};

    explicit KernelAmbientLight(const Params& params) : AmbientLightParams<Params>(params) {}
    int sample_count() const noexcept override { return 0; }
    void illuminate_ambient(const ReceiverBatch& receivers, const Vec3Span& ambient) const override {
        multiversion<IlluminateAmbientLoop<Params, illuminate_ambient_>>(this->params(), receivers, ambient);
    }
};

}  // namespace candela::sdk
