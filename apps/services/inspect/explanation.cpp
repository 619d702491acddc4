#include "inspect/explanation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <utility>

import candela.api;

using candela::InspectedFragment;
using candela::LightTrace;
using candela::Object;
using candela::ParamValue;
using candela::PluginDescriptor;
using candela::PluginKind;
using candela::PointTrace;
using candela::RenderScene;
using candela::Scene;
using candela::Vec3;

namespace {

/// Numbers in the order of the members of the kernel's structs.
class Numbers {
  public:
    Numbers& add(std::initializer_list<Vec3> vectors) {
        for (const Vec3 v : vectors) all_.insert(all_.end(), {v.x, v.y, v.z});
        return *this;
    }
    Numbers& add_uv(const PointTrace& point) {
        all_.insert(all_.end(), {point.u, point.v});
        return *this;
    }
    const std::vector<float>& all() const { return all_; }

  private:
    std::vector<float> all_;
};

Numbers receiver(const PointTrace& point) { return Numbers().add({point.position, point.normal}); }

Numbers surface(const PointTrace& point) {
    return Numbers()
        .add({point.normal, point.to_observer, point.tangent, point.color, point.position})
        .add_uv(point);
}

Numbers shading_point_and_triangle(const PointTrace& point) {
    const auto& p = point.corner_position;
    const auto& n = point.corner_normal;
    return Numbers()
        .add({point.face_normal, point.vertex_normal, point.barycentric})
        .add_uv(point)
        .add({point.dpdu, point.dpdv, p[0], p[1], p[2], n[0], n[1], n[2]});
}

/// The values that an instance was made with, and the tables it computed from them.
std::vector<ParamValue> values_of(const PluginDescriptor& plugin, const candela::ParamSet& parameters,
                                  candela::ColorEncoding encoding, const candela::Instance& instance) {
    std::vector<ParamValue> values = parameters.runtime(encoding);
    for (const std::size_t i : plugin.kernel.members) values[i].list = instance.table(i);
    return values;
}

}  // namespace

std::vector<const PluginDescriptor*> plugins_explained_in(const Scene& scene, candela::Registry& registry) {
    std::vector<const PluginDescriptor*> plugins;
    const auto add = [&](PluginKind kind, const std::string& name) {
        const PluginDescriptor* const plugin = registry.require(kind, name).descriptor;
        if (std::ranges::find(plugins, plugin) == plugins.end()) plugins.push_back(plugin);
    };
    for (const Object& object : scene.objects) {
        add(PluginKind::shading, object.shading.name);
        add(PluginKind::reflection, object.reflection.name);
    }
    for (const candela::LightSource& light : scene.lights) add(PluginKind::light, light.model.name);
    return plugins;
}

Explanation::Explanation(const Scene& of_scene, const RenderScene& of_compiled, candela::Registry& registry,
                         int at_x, int at_y, KernelRunner& kernels)
    : x(at_x),
      y(at_y),
      scene(of_scene),
      compiled(of_compiled),
      pixel(candela::inspect_pixel(of_compiled, at_x, at_y)) {
    for (const InspectedFragment& fragment : pixel.fragments) add_calls(fragment, registry);
    values_ = kernels.run(calls_);
    why_no_steps_ = kernels.why_not();
}

std::size_t Explanation::add(KernelCall call) {
    calls_.push_back(std::move(call));
    return calls_.size() - 1;
}

void Explanation::add_calls(const InspectedFragment& fragment, candela::Registry& registry) {
    const Object& object = scene.objects[fragment.object];
    const auto encoding = scene.image.color_management;
    const auto descriptor = [&](PluginKind kind, const std::string& name) {
        return registry.require(kind, name).descriptor;
    };
    const PluginDescriptor* const shading = descriptor(PluginKind::shading, object.shading.name);
    const PluginDescriptor* const reflection = descriptor(PluginKind::reflection, object.reflection.name);
    const candela::SurfaceModels& models = compiled.objects[fragment.object].surface;
    for (const PointTrace& point : fragment.points) {
        points_.push_back(
            {&point, add({.plugin = shading,
                          .values = values_of(*shading, object.shading.parameters, encoding, *models.shading),
                          .function = "normal",
                          .arguments = shading_point_and_triangle(point).all()})});
        for (const LightTrace& light : point.lights) {
            if (light.sample == LightTrace::k_mirrored) continue;
            const candela::Model& model = scene.lights[light.light].model;
            const PluginDescriptor* const light_plugin = descriptor(PluginKind::light, model.name);
            const bool is_ambient = light.sample == LightTrace::k_ambient;
            const std::size_t illuminate = add({.plugin = light_plugin,
                                                .values = values_of(*light_plugin, model.parameters, encoding,
                                                                    *compiled.lights[light.light].light),
                                                .function = is_ambient ? "illuminate_ambient" : "illuminate",
                                                .arguments = receiver(point).all(),
                                                .sample = light.sample});
            std::vector<ParamValue> material =
                values_of(*reflection, object.reflection.parameters, encoding, *models.reflection);
            for (const candela::VaryingValue& own : point.parameters)
                material[own.parameter].number[own.channel] = own.value;
            const std::size_t reflect =
                add({.plugin = reflection,
                     .values = std::move(material),
                     .function = is_ambient ? "reflect_ambient" : "reflect",
                     .arguments =
                         is_ambient ? surface(point).all() : surface(point).add({light.to_light}).all()});
            lights_.push_back({&light, illuminate, reflect});
        }
    }
}

const std::vector<KernelValue>& Explanation::normal_steps(const PointTrace& point) const {
    return values_.at(std::ranges::find(points_, &point, &CallOfPoint::trace)->normal);
}
const std::vector<KernelValue>& Explanation::light_steps(const LightTrace& light) const {
    return values_.at(std::ranges::find(lights_, &light, &CallsOfLight::trace)->illuminate);
}
const std::vector<KernelValue>& Explanation::reflection_steps(const LightTrace& light) const {
    return values_.at(std::ranges::find(lights_, &light, &CallsOfLight::trace)->reflect);
}

bool Explanation::may_be_blocked(const LightTrace& light) const {
    const candela::LightSource& source = scene.lights[light.light];
    if (!scene.shadows.enabled || light.sample == LightTrace::k_mirrored) return false;
    return light.sample == LightTrace::k_ambient ? source.ambient_occlusion.rays > 0 : source.casts_shadows;
}

double Explanation::luminance() const {
    // ITU-R BT.709
    const auto of = [](candela::Vec3 rgb) {
        return 0.2126 * static_cast<double>(rgb.x) + 0.7152 * static_cast<double>(rgb.y) +
               0.0722 * static_cast<double>(rgb.z);
    };
    const bool is_background_light = !compiled.environment.is_uniform();
    const double behind =
        is_background_light ? 0 : static_cast<double>(pixel.background_weight) * of(pixel.background);
    return std::max(0.0, of(pixel.intensity) - behind);
}

std::optional<double> Explanation::kernel_difference() const {
    std::optional<double> largest;
    for (const InspectedFragment& fragment : pixel.fragments) {
        for (const PointTrace& point : fragment.points) {
            const double scale = std::max({point.intensity.x, point.intensity.y, point.intensity.z, 1e-3f});
            for (const LightTrace& light : point.lights) {
                if (light.sample == LightTrace::k_mirrored) continue;
                const auto compare = [&](const KernelValue& value, Vec3 arriving, Vec3 reflected) {
                    if (value.numbers.size() != 3) return;
                    const std::array<double, 3> by_plugin{reflected.x, reflected.y, reflected.z};
                    const std::array<double, 3> sent{arriving.x, arriving.y, arriving.z};
                    for (std::size_t c = 0; c < 3; ++c) {
                        const double difference = std::abs(value.numbers[c] * sent[c] - by_plugin[c]) / scale;
                        largest = std::max(largest.value_or(0), difference);
                    }
                };
                for (const KernelValue& value : reflection_steps(light)) {
                    if (value.depth != 0 || value.step->kind != KernelStep::Kind::result) continue;
                    if (value.member.empty())
                        compare(value, point.occlusion * light.diffuse, light.reflected_ambient);
                    if (value.member == ".diffuse") compare(value, light.diffuse, light.reflected_diffuse);
                    if (value.member == ".specular") compare(value, light.specular, light.reflected_specular);
                }
            }
        }
    }
    return largest;
}
