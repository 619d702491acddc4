module;

#include "candela/kernel/batch.h"
#include "candela/kernel/kernel.h"
#include "candela/kernel/simd_dispatch.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

module candela.shading;

import :guarded;
import :light_visibility;
import :clearing;
import :common_material;
import :object_environment;
import candela.api;
import candela.plugins;
import candela.raster;
import candela.util;

namespace candela {

namespace {

using kernel::vec3;

/// V: towards the eye, or against the view direction in an orthographic picture.
struct ToObserverLoop {
    CANDELA_BATCH_LOOP static void run(Camera camera, ConstVec3Span position, std::size_t count,
                                       Vec3Span to_observer) {
        const bool perspective = camera.projection == Projection::perspective;
        const Vec3 against = -camera.forward;
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) {
            const Vec3 d = perspective ? camera.eye - position[i] : against;
            kernel::store(to_observer, i, kernel::normalize(vec3(d.x, d.y, d.z)));
        }
    }
};

struct FaceForwardLoop {
    CANDELA_BATCH_LOOP static void run(const float* facing, std::size_t count, Vec3Span v) {
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) {
            kernel::store(v, i, kernel::load(v, i) * facing[i]);
        }
    }
};

/// dp/du without its part along N (Gram-Schmidt).
struct TangentLoop {
    CANDELA_BATCH_LOOP static void run(ConstVec3Span dpdu, ConstVec3Span normal, std::size_t count,
                                       Vec3Span tangent) {
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) {
            const vec3 n = kernel::load(normal, i);
            const vec3 u = kernel::load(dpdu, i);
            kernel::store(tangent, i, kernel::normalize(u - n * kernel::dot(n, u)));
        }
    }
};

/// Adds up arrays, and finds the largest magnitude among the sums; a non-finite number counts as larger than
/// all finite ones. Without their sign, the bits of floats have the same order as integers, whose maximum is
/// vectorised.
template <std::size_t terms>
struct SumLoop {
    CANDELA_BATCH_LOOP static void run(std::array<ConstVec3Span, terms> of, std::size_t count, Vec3Span sum,
                                       std::int32_t* bits) {
        constexpr std::int32_t k_magnitude = 0x7fff'ffff;
        std::int32_t largest = 0;
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) {
            vec3 s = kernel::load(of[0], i);
            for (std::size_t k = 1; k < terms; ++k) s = s + kernel::load(of[k], i);
            const std::int32_t x = std::bit_cast<std::int32_t>(s.x) & k_magnitude;
            const std::int32_t y = std::bit_cast<std::int32_t>(s.y) & k_magnitude;
            const std::int32_t z = std::bit_cast<std::int32_t>(s.z) & k_magnitude;
            const std::int32_t xy = x > y ? x : y;
            const std::int32_t xyz = xy > z ? xy : z;
            largest = largest > xyz ? largest : xyz;
            kernel::store(sum, i, s);
        }
        *bits = largest;
    }
};

template <std::size_t terms>
float add(const std::array<ConstVec3Span, terms>& of, std::size_t count, const Vec3Span& sum) {
    std::int32_t bits = 0;
    std::int32_t* const result = &bits;
    multiversion<SumLoop<terms>>(of, count, sum, result);
    return std::bit_cast<float>(bits);
}

bool are_finite(ConstVec3Span v, std::size_t count) {
    bool finite = true;
    for (const float* const channel : {v.x, v.y, v.z}) {
        for (std::size_t i = 0; i < count; ++i) finite = finite && std::isfinite(channel[i]);
    }
    return finite;
}

/// The size of the canary after the batch arrays' last element, in floats.
constexpr std::size_t k_guard_size = 16;

/// The number of points of a batch that are lit: whole vectors, unless rays are followed from each of them.
std::size_t lit_of(const SurfaceModels& surface, const SurfacePoints& points) {
    return surface.environment_reflection != nullptr ? points.count : points.filled;
}

/// Empty if the light does not describe itself.
std::optional<LightData> data_of(const Light& light, bool has_ambient) {
    const int samples = light.sample_count();
    const auto* const punctual = extension_of<PunctualSource>(light);
    const auto* const ambient = extension_of<UniformAmbientSource>(light);
    if ((samples > 0 && punctual == nullptr) || (has_ambient && ambient == nullptr)) return std::nullopt;
    LightData data;
    for (int sample = 0; sample < samples; ++sample) data.samples.push_back(punctual->as_punctual(sample));
    if (has_ambient) data.ambient = ambient->as_ambient();
    return data;
}

}  // namespace

RenderLight render_light(Registry& registry, const Model& model, ColorEncoding encoding) {
    RenderLight made{.plugin = model.name,
                     .light = registry.create<Light>(model.name, model.parameters, encoding),
                     .has_ambient = registry.descriptor(PluginKind::light, model.name).has_ambient};
    guarded(PluginKind::light, made.plugin, [&] { made.data = data_of(*made.light, made.has_ambient); });
    made.sky = extension_of<SkySource>(*made.light);
    return made;
}

void SurfaceModels::set_shading(Registry& registry, const Model& model, ColorEncoding encoding) {
    shading = registry.create<ShadingModel>(model.name, model.parameters, encoding);
    shading_plugin = model.name;
    shading_needs = registry.descriptor(PluginKind::shading, model.name).shading_needs;
}

void SurfaceModels::set_reflection(Registry& registry, const Model& model, ColorEncoding encoding) {
    reflection = registry.create<ReflectionModel>(model.name, model.parameters, encoding);
    reflection_plugin = model.name;
    const PluginDescriptor& descriptor = registry.descriptor(PluginKind::reflection, model.name);
    reflection_needs = descriptor.surface_needs;
    lights_below_horizon = std::ranges::any_of(descriptor.properties, [](const Property& property) {
        return std::string_view(property.name) == "lights-below-horizon";
    });
    all_lights_reflection = extension_of<AllLightsReflection>(*reflection);
    environment_reflection = extension_of<EnvironmentReflection>(*reflection);
    glossy_reflection = extension_of<GlossyReflection>(*reflection);
}

PointNeeds SurfaceModels::needs() const {
    return {.face_normal = shading_needs.face_normal,
            .vertex_normal = shading_needs.vertex_normal,
            .barycentric = shading_needs.barycentric,
            .uv = shading_needs.uv || reflection_needs.uv || has_pictures(),
            .footprint = has_pictures(),
            .derivatives =
                shading_needs.derivatives || reflection_needs.tangent || material_textures.normal.has_value(),
            .triangle = shading_needs.triangle,
            .channels = has_channels};
}

TexturedPoints textured(const SurfacePoints& points) {
    TexturedPoints at{.channels = points.channels};
    at.uv[0] = {.uv = {points.u.data(), points.v.data()},
                .per_x = {points.dudx.data(), points.dvdx.data()},
                .per_y = {points.dudy.data(), points.dvdy.data()}};
    const auto& second = points.second_footprint;
    if (points.channels.size() >= 2)
        at.uv[1] = {.uv = {points.channels[0].data(), points.channels[1].data()},
                    .per_x = {second[0].data(), second[1].data()},
                    .per_y = {second[2].data(), second[3].data()}};
    return at;
}

void apply_textures(const SurfaceModels& surface, SurfacePoints& points) {
    if (!surface.has_textures()) return;
    const TexturedPoints at = textured(points);
    const std::size_t arrays = surface.material_textures.arrays();
    while (points.parameters.size() < arrays) points.parameters.emplace_back(k_batch_size);
    evaluate(surface.material_textures, points.filled, at, points.parameters);
    const std::size_t first = surface.material_textures.color;
    if (first == MaterialTextures::k_none) return;
    // With a texture, the object's own colour is white.
    const std::array<float*, 3> channels{points.color.x.data(), points.color.y.data(), points.color.z.data()};
    for (std::size_t c = 0; c < channels.size(); ++c) {
        const float* const texture = points.parameters[first + c].data();
        for (std::size_t i = 0; i < points.filled; ++i)
            channels[c][i] = points.has_color ? channels[c][i] * texture[i] : texture[i];
    }
    points.has_color = true;
}

void shading_normals(const SurfaceModels& surface, const SurfacePoints& points, const Vec3Span& normal) {
    const ShadingNeeds& needs = surface.shading_needs;
    TriangleBatch triangle;
    const bool has_triangle = needs.triangle && surface.shading->shading_rate() != ShadingRate::vertex;
    for (std::size_t k = 0; has_triangle && k < 3; ++k) {
        triangle.position[k] = points.corner_position[k].span();
        triangle.normal[k] = points.corner_normal[k].span();
    }
    const ShadingPointBatch batch{
        .count = points.filled,
        .face_normal = needs.face_normal ? points.face_normal.span() : ConstVec3Span{},
        .vertex_normal = needs.vertex_normal ? points.vertex_normal.span() : ConstVec3Span{},
        .barycentric = needs.barycentric ? points.barycentric.span() : ConstVec3Span{},
        .uv = needs.uv ? ConstVec2Span{points.u.data(), points.v.data()} : ConstVec2Span{},
        .dpdu = needs.derivatives ? points.dpdu.span() : ConstVec3Span{},
        .dpdv = needs.derivatives ? points.dpdv.span() : ConstVec3Span{},
        .triangle = has_triangle ? &triangle : nullptr};
    surface.shading->normals(batch, normal);
}

SurfaceShader::SurfaceShader() {
    for (AlignedVector<float>* const array : {&distance_, &attenuation_, &widths_})
        array->resize(k_batch_size + k_guard_size);
    zeros_.resize(k_batch_size);
    for (Vec3Arrays* const arrays : {&to_observer_, &tangent_}) arrays->resize(k_batch_size);
    for (Vec3Arrays* const arrays : written_by_plugins()) arrays->resize(k_batch_size + k_guard_size);
    mark_ends();
}

SurfaceShader::~SurfaceShader() = default;

void SurfaceShader::begin(const LightingContext& scene) {
    scene_ = scene;
    if (scene.occlusion != nullptr && visibility_ == nullptr)
        visibility_ = std::make_unique<LightVisibility>();
    if (visibility_ != nullptr) visibility_->begin(scene);
    surroundings_.reset();
    lights_.clear();
    for (const RenderLight& source : scene.lights) lights_.push_back(&source);
    at_once_ = lights_at_once(false);
    const bool is_mirrored = std::ranges::any_of(
        scene.lights, [](const RenderLight& source) { return source.radiance != nullptr; });
    glossy_at_once_ = is_mirrored ? lights_at_once(true) : LightsAtOnce();
}

SurfaceShader::LightsAtOnce SurfaceShader::lights_at_once(bool is_glossy) const {
    LightsAtOnce all;
    const bool has_shadows = scene_.occlusion != nullptr;
    for (const RenderLight& source : scene_.lights) {
        const bool varies = scene_.pattern == ShadowPattern::varied && source.has_extent();
        const bool is_one_by_one =
            has_shadows && ((source.casts_shadows && varies) || source.ambient_occlusion.rays > 0);
        if (!source.data || is_one_by_one || (is_glossy && source.radiance != nullptr)) {
            all.others.push_back(&source);
            continue;
        }
        all.punctual.insert(all.punctual.end(), source.data->samples.begin(), source.data->samples.end());
        all.is_blocked.resize(all.punctual.size(), has_shadows && source.casts_shadows);
        all.lighting.ambient = all.lighting.ambient + source.data->ambient;
    }
    const bool is_perspective = scene_.camera.projection == Projection::perspective;
    all.lighting.observer = is_perspective ? scene_.camera.eye : -scene_.camera.forward;
    all.lighting.w = is_perspective ? 1.0f : 0.0f;
    return all;
}

const SurfaceShader::LightsAtOnce& SurfaceShader::at_once(const SurfaceModels& surface) const {
    const bool mirrors_some = surface.glossy_reflection != nullptr && !glossy_at_once_.others.empty();
    return mirrors_some ? glossy_at_once_ : at_once_;
}

std::array<Vec3Arrays*, 8> SurfaceShader::written_by_plugins() {
    return {&normal_,  &to_light_, &light_diffuse_, &light_specular_,
            &ambient_, &diffuse_,  &specular_,      &reflected_};
}

void SurfaceShader::mark_ends() {
    for (Vec3Arrays* const arrays : written_by_plugins()) {
        for (AlignedVector<float>* const array : {&arrays->x, &arrays->y, &arrays->z})
            fill_with_canary(std::span(*array).subspan(k_batch_size));
    }
}

bool SurfaceShader::are_ends_intact(std::span<Vec3Arrays* const> written) {
    bool intact = true;
    for (const Vec3Arrays* const arrays : written) {
        for (const AlignedVector<float>* const array : {&arrays->x, &arrays->y, &arrays->z})
            intact &= is_canary_intact(std::span(*array).subspan<k_batch_size, k_guard_size>());
    }
    return intact;
}

void SurfaceShader::require_sound(PluginKind kind, const std::string& plugin, std::size_t count,
                                  std::initializer_list<const Vec3Arrays*> results) {
    const auto fail = [&](const char* what) {
        throw Error(ErrorCategory::failure, fmt::format("plugin {} {}", plugin_id(kind, plugin), what),
                    {Help::Topic::plugin_conformance});
    };
    if (!are_ends_intact(written_by_plugins())) {
        mark_ends();
        fail("wrote past the end of its batch");
    }
    for (const Vec3Arrays* arrays : results) {
        if (!are_finite(arrays->span(), count)) fail("returned a non-finite value");
    }
}

void SurfaceShader::find_normals(const SurfaceModels& surface, const SurfacePoints& points) {
    guarded(PluginKind::shading, surface.shading_plugin,
            [&] { shading_normals(surface, points, normal_.span()); });
    tilt_normals(surface, points, normal_.span());
    if (points.any_from_behind)
        multiversion<FaceForwardLoop>(points.facing.data(), points.filled, normal_.span());
}

float SurfaceShader::shade(const SurfaceModels& surface, const ShadedObject& object,
                           const SurfacePoints& points, const Vec3Span& intensity) {
    const std::size_t count = lit_of(surface, points);
    set_varying(surface, points);
    find_normals(surface, points);
    has_shadows_ = visibility_ != nullptr &&
                   visibility_->set_points(surface, object, points, std::as_const(normal_).span());
    const ConstVec3Span ambient = std::as_const(ambient_).span(), diffuse = std::as_const(diffuse_).span(),
                        specular = std::as_const(specular_).span(),
                        reflected = std::as_const(reflected_).span();
    float largest = 0;
    Vec3Arrays* const in_one_go[] = {&normal_, &reflected_};
    const std::array all = written_by_plugins();
    std::span<Vec3Arrays* const> written = all;
    if (!reflect_all_lights(surface, points)) {
        add_up(surface, object, points, lights_, Checking::none);
        largest = add<3>({ambient, diffuse, specular}, count, intensity);
    } else if (at_once(surface).others.empty()) {
        largest = add<1>({reflected}, count, intensity);
        written = in_one_go;
    } else {
        add_up(surface, object, points, at_once(surface).others, Checking::none);
        largest = add<4>({reflected, ambient, diffuse, specular}, count, intensity);
    }
    if (!std::isfinite(largest) || !are_ends_intact(written)) check_steps(surface, object, points);
    const bool is_of_lights_only = scene_.environment == nullptr;
    if (!surface.emits() || is_of_lights_only) return largest;
    add_emission(surface, points, count, intensity);
    return add<1>({ConstVec3Span{intensity.x, intensity.y, intensity.z}}, count, intensity);
}

void SurfaceShader::check_steps(const SurfaceModels& surface, const ShadedObject& object,
                                const SurfacePoints& points) {
    mark_ends();
    find_normals(surface, points);
    const std::size_t count = lit_of(surface, points);
    require_sound(PluginKind::shading, surface.shading_plugin, count, {&normal_});
    add_up(surface, object, points, lights_, Checking::each_step);
    if (reflect_all_lights(surface, points))
        require_sound(PluginKind::reflection, surface.reflection_plugin, count, {&reflected_});
}

bool SurfaceShader::reflect_all_lights(const SurfaceModels& surface, const SurfacePoints& points) {
    const LightsAtOnce& all = at_once(surface);
    if (all.others.size() == lights_.size() || surface.all_lights_reflection == nullptr ||
        surface.environment_reflection != nullptr || surface.is_occluded())
        return false;
    // Weights have no colour.
    if (has_shadows_ && scene_.occlusion->has_transparent()) return false;
    const std::size_t count = lit_of(surface, points);
    find_tangents(surface, points, count);
    PunctualLighting lighting = all.lighting;
    lighting.lights = all.punctual;
    if (has_shadows_) lighting.visibility = visibility_of_data(all, points);
    SurfaceBatch batch = lit_surface(surface, points, count);
    batch.to_observer = {};
    guarded(PluginKind::reflection, surface.reflection_plugin,
            [&] { surface.all_lights_reflection->reflect_all_lights(batch, lighting, reflected_.span()); });
    return true;
}

void SurfaceShader::set_varying(const SurfaceModels& surface, const SurfacePoints& points) {
    varying_.clear();
    const std::vector<TexturedNumber>& numbers = surface.material_textures.numbers;
    for (std::size_t i = 0; i < surface.material_textures.of_model; ++i)
        varying_.push_back({numbers[i].parameter, numbers[i].channel, points.parameters[i].data()});
}

void SurfaceShader::find_tangents(const SurfaceModels& surface, const SurfacePoints& points,
                                  std::size_t count) {
    if (surface.reflection_needs.tangent)
        multiversion<TangentLoop>(points.dpdu.span(), std::as_const(normal_).span(), count, tangent_.span());
}

SurfaceBatch SurfaceShader::lit_surface(const SurfaceModels& surface, const SurfacePoints& points,
                                        std::size_t count) const {
    const SurfaceNeeds& needs = surface.reflection_needs;
    return {.count = count,
            .normal = normal_.span(),
            .to_observer = to_observer_.span(),
            .tangent = needs.tangent ? tangent_.span() : ConstVec3Span{},
            .color = surface.color,
            .position = points.position.span(),
            .uv = needs.uv ? ConstVec2Span{points.u.data(), points.v.data()} : ConstVec2Span{},
            .point_color = points.has_color ? points.color.span() : ConstVec3Span{},
            .varying = varying_};
}

void SurfaceShader::add_up(const SurfaceModels& surface, const ShadedObject& object,
                           const SurfacePoints& points, const Lights& lights, Checking checking) {
    const std::size_t count = lit_of(surface, points);
    const auto look_at = [&](PluginKind kind, const std::string& plugin,
                             std::initializer_list<const Vec3Arrays*> results) {
        if (checking == Checking::each_step) require_sound(kind, plugin, count, results);
    };
    multiversion<ToObserverLoop>(scene_.camera, points.position.span(), count, to_observer_.span());
    find_tangents(surface, points, count);
    const SurfaceBatch batch = lit_surface(surface, points, count);
    const ReflectedBatch reflected{ambient_.span(), diffuse_.span(), specular_.span()};
    for (const Vec3Span& sum : {reflected.ambient, reflected.diffuse, reflected.specular}) clear(sum, count);

    const bool is_mirror =
        std::ranges::any_of(lights, [&](const RenderLight* source) { return mirrors(surface, *source); });
    if (is_mirror) find_widths(surface, batch);
    for (const RenderLight* const light : lights) {
        const RenderLight& source = *light;
        const bool is_mirrored = mirrors(surface, source);
        for (int sample = 0; sample < source.light->sample_count(); ++sample) {
            const auto shadowed = illuminate(source, sample, points, count);
            look_at(PluginKind::light, source.plugin, {&to_light_, &light_diffuse_, &light_specular_});
            if (shadowed) block(*shadowed, count);
            if (is_mirrored) share_with_mirror(source, count);
            guarded(PluginKind::reflection, surface.reflection_plugin, [&] {
                surface.reflection->reflect(
                    batch, {to_light_.span(), light_diffuse_.span(), light_specular_.span()}, reflected);
            });
            look_at(PluginKind::reflection, surface.reflection_plugin, {&diffuse_, &specular_});
        }
        if (is_mirrored) {
            add_mirrored(source, surface, points, batch, reflected);
            look_at(PluginKind::reflection, surface.reflection_plugin, {&specular_});
        }
        if (source.has_ambient) {
            illuminate_ambient(source, points, count);
            look_at(PluginKind::light, source.plugin, {&light_diffuse_});
            block_ambient(source, count);
            guarded(PluginKind::reflection, surface.reflection_plugin,
                    [&] { surface.reflection->reflect_ambient(batch, light_diffuse_.span(), reflected); });
            look_at(PluginKind::reflection, surface.reflection_plugin, {&ambient_});
        }
    }
    if (surface.is_occluded()) occlude(surface, points, count, reflected.ambient);
    if (surface.environment_reflection != nullptr && scene_.environment != nullptr) {
        if (surroundings_ == nullptr)
            surroundings_ = std::make_unique<ObjectEnvironment>(*scene_.environment);
        surroundings_->set_object(surface, object);
        guarded(PluginKind::reflection, surface.reflection_plugin,
                [&] { surface.environment_reflection->show_environment(batch, *surroundings_, reflected); });
        look_at(PluginKind::reflection, surface.reflection_plugin, {&specular_});
    }
}

}  // namespace candela
