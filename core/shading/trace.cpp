module;

#include <cstddef>
#include <memory>
#include <stdexcept>
#include <utility>

module candela.shading;

import :clearing;
import :common_material;
import :guarded;
import :light_visibility;
import :object_environment;
import :trace;
import candela.api;
import candela.plugins;
import candela.raster;

namespace candela {

namespace {

Vec3 first_of(const Vec3Arrays& arrays) { return arrays.span()[0]; }

}  // namespace

// The sums are those of shade(); each light's share is then computed separately.
PointTrace SurfaceShader::trace(const SurfaceModels& surface, const ShadedObject& object,
                                const SurfacePoints& points) {
    if (points.count != 1) throw std::invalid_argument("SurfaceShader::trace() traces a single point");
    Vec3Arrays intensity;
    intensity.resize(k_batch_size);
    shade(surface, object, points, intensity.span());
    add_up(surface, object, points, lights_, Checking::none);
    PointNeeds needs = surface.needs();
    needs.triangle &= surface.shading->shading_rate() != ShadingRate::vertex;
    const bool needs_tangent = surface.reflection_needs.tangent;
    PointTrace trace{.position = first_of(points.position),
                     .normal = first_of(normal_),
                     .to_observer = first_of(to_observer_),
                     .tangent = needs_tangent ? first_of(tangent_) : Vec3{},
                     .color = points.has_color ? first_of(points.color)
                                               : Vec3{surface.color.r, surface.color.g, surface.color.b},
                     .face_normal = first_of(points.face_normal),
                     .vertex_normal = first_of(points.vertex_normal),
                     .barycentric = first_of(points.barycentric),
                     .u = needs.uv ? points.u[0] : 0,
                     .v = needs.uv ? points.v[0] : 0,
                     .dpdu = needs.derivatives ? first_of(points.dpdu) : Vec3{},
                     .dpdv = needs.derivatives ? first_of(points.dpdv) : Vec3{},
                     .from_behind = points.facing[0] < 0,
                     .occlusion = occlusion_at(surface, points, 0),
                     .ambient = first_of(ambient_),
                     .diffuse = first_of(diffuse_),
                     .specular = first_of(specular_),
                     .intensity = first_of(intensity)};

    if (object.mesh != nullptr && object.mesh->has_second_uv && needs.channels)
        trace.second_uv = {points.channels[0][0], points.channels[1][0]};
    trace.shading_normal = trace.normal;
    if (surface.material_textures.normal) {
        shading_normals(surface, points, tangent_.span());
        trace.shading_normal = points.facing[0] * first_of(tangent_);
        const auto* const channel = &points.parameters[surface.material_textures.numbers.size()];
        trace.normal_texel = {channel[0][0], channel[1][0], channel[2][0]};
    }
    Vec3 emission;
    find_emission(surface, points, 1, {&emission.x, &emission.y, &emission.z});
    trace.emission = emission;
    for (const VaryingParameter& one : varying_)
        trace.parameters.push_back({one.parameter, one.channel, one.values[0]});
    for (std::size_t k = 0; needs.triangle && k < 3; ++k) {
        trace.corner_position[k] = first_of(points.corner_position[k]);
        trace.corner_normal[k] = first_of(points.corner_normal[k]);
    }
    const std::size_t count = surface.environment_reflection != nullptr ? points.count : points.filled;
    const SurfaceBatch batch = lit_surface(surface, points, count);
    const ReflectedBatch reflected{ambient_.span(), diffuse_.span(), specular_.span()};
    const auto start = [&] {
        for (const Vec3Span& part : {reflected.ambient, reflected.diffuse, reflected.specular})
            clear(part, count);
    };
    const auto add = [&](LightTrace light) {
        light.reflected_ambient = first_of(ambient_);
        light.reflected_diffuse = first_of(diffuse_);
        light.reflected_specular = first_of(specular_);
        trace.lights.push_back(light);
    };
    for (std::size_t i = 0; i < scene_.lights.size(); ++i) {
        const RenderLight& source = scene_.lights[i];
        const bool is_mirrored = mirrors(surface, source);
        if (is_mirrored) find_widths(surface, batch);
        for (int sample = 0; sample < source.light->sample_count(); ++sample) {
            start();
            LightTrace light{.light = i, .sample = sample};
            if (const auto shadowed = illuminate(source, sample, points, count)) {
                block(*shadowed, count);
                light.visibility = visibility_->find(*shadowed)[0];
                light.blocker = visibility_->find_blocker(*shadowed);
            }
            if (is_mirrored) share_with_mirror(source, count);
            guarded(PluginKind::reflection, surface.reflection_plugin, [&] {
                surface.reflection->reflect(
                    batch, {to_light_.span(), light_diffuse_.span(), light_specular_.span()}, reflected);
            });
            light.to_light = first_of(to_light_);
            light.diffuse = first_of(light_diffuse_);
            light.specular = first_of(light_specular_);
            add(light);
        }
        if (is_mirrored) {
            start();
            add_mirrored(source, surface, points, batch, reflected);
            add({.light = i, .sample = LightTrace::k_mirrored});
        }
        if (source.has_ambient) {
            start();
            LightTrace light{.light = i};
            illuminate_ambient(source, points, count);
            if (block_ambient(source, count))
                light.visibility = visibility_->find_ambient(source.ambient_occlusion)[0];
            guarded(PluginKind::reflection, surface.reflection_plugin,
                    [&] { surface.reflection->reflect_ambient(batch, light_diffuse_.span(), reflected); });
            if (surface.is_occluded()) occlude(surface, points, count, reflected.ambient);
            light.diffuse = first_of(light_diffuse_);
            add(light);
        }
    }
    if (surface.environment_reflection != nullptr) {
        start();
        guarded(PluginKind::reflection, surface.reflection_plugin,
                [&] { surface.environment_reflection->show_environment(batch, *surroundings_, reflected); });
        trace.surroundings = first_of(specular_);
    }
    return trace;
}

}  // namespace candela
