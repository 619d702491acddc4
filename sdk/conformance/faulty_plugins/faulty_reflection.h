// Shared by the faulty plugins: a handwritten matt reflection model without fault, to be spoiled.
#pragma once

#include <cstddef>
#include <fstream>
#include <span>
#include <string>

#include "candela/image_plugin.h"
#include "candela/reflection_plugin.h"

namespace faulty {

/// Even a plugin that does harm when loaded needs its manifest written.
inline bool is_being_described() {
    std::string name;
    std::getline(std::ifstream("/proc/self/comm"), name);
    return name.starts_with("candela-manif");
}

struct Params {
    candela::sdk::vec3 kd;
};

constexpr auto k_fields = candela::sdk::fields(
    candela::sdk::coefficient(&Params::kd, "kd", 0.5f, "how much light is reflected diffusely"));

class Matt : public candela::ReflectionModel {
  public:
    /// For plugins that have a kernel.
    static constexpr candela::KernelFunction k_kernel_functions[] = {{"reflect", true},
                                                                     {"reflect_ambient", true}};

    explicit Matt(const Params& params) : kd_(params.kd.x) {}

    void reflect(const candela::SurfaceBatch& s, const candela::LightingBatch& light,
                 const candela::ReflectedBatch& out) const override {
        for (std::size_t i = 0; i < s.count; ++i) add(out.diffuse, i, factor(s, light, i), light.diffuse[i]);
    }
    void reflect_ambient(const candela::SurfaceBatch& s, const candela::ConstVec3Span& ambient,
                         const candela::ReflectedBatch& out) const override {
        for (std::size_t i = 0; i < s.count; ++i) add(out.ambient, i, kd_, ambient[i]);
    }

  protected:
    virtual float factor(const candela::SurfaceBatch& s, const candela::LightingBatch& light,
                         std::size_t i) const {
        const float cosine = dot(s.normal[i], light.to_light[i]);
        return cosine > 0 ? kd_ * cosine : 0;
    }
    static void add(const candela::Vec3Span& out, std::size_t i, float factor, candela::Vec3 light) {
        out.set(i, out[i] + factor * light);
    }
    float kd_;
};

/// A PPM writer without fault.
class Ppm : public candela::ImageFormat {
  public:
    explicit Ppm(const candela::sdk::NoParams&) {}

    void write(const candela::ImageView& picture, const char*, candela::ByteSink& sink) const override {
        const std::string head =
            "P6\n" + std::to_string(picture.width) + ' ' + std::to_string(picture.height) + "\n255\n";
        sink.write(std::as_bytes(std::span(head)));
        std::string pixels(picture.bytes.size(), '\0');
        for (std::size_t i = 0; i < pixels.size(); ++i)
            pixels[i] = static_cast<char>(picture.bytes[i - i % 3 + channel(i % 3)]);
        sink.write(std::as_bytes(std::span(pixels)));
    }

  protected:
    virtual std::size_t channel(std::size_t c) const { return c; }
};

constexpr candela::FileFormat k_formats[] = {{"ppm", "Portable pixmap"}};

}  // namespace faulty

#define FAULTY_PLUGIN(Model, ...)            \
    CANDELA_PLUGIN(                          \
        reflection, Model, faulty::k_fields, \
        {.title = #Model, .summary = "Bad on purpose.", .reference = "none" __VA_OPT__(, ) __VA_ARGS__})

/// A plugin with the kernel text in the file next to it.
#define FAULTY_KERNEL_PLUGIN(Model, prefix)                                            \
    CANDELA_KERNEL_PLUGIN(reflection, Model, prefix, faulty::Params, faulty::k_fields, \
                          {.title = #prefix, .summary = "Bad on purpose.", .reference = "none"})

#define FAULTY_FORMAT(Format)                     \
    CANDELA_PLUGIN(                               \
        image, Format, candela::sdk::k_no_fields, \
        {.title = #Format, .summary = "Bad on purpose.", .reference = "none", .formats = faulty::k_formats})
