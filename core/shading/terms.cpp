module;

#include <algorithm>
#include <array>
#include <cstddef>
#include <stdexcept>
#include <utility>

module candela.shading;

import :clearing;
import :common_material;
import :light_visibility;
import :term;
import :texture;
import candela.api;

namespace candela {

namespace {

void copy(const Vec3Arrays& from, std::size_t count, const Vec3Span& to) {
    std::copy_n(from.x.begin(), count, to.x);
    std::copy_n(from.y.begin(), count, to.y);
    std::copy_n(from.z.begin(), count, to.z);
}

void find_color(const SurfaceModels& surface, const SurfacePoints& points, const Vec3Span& values) {
    if (points.has_color) return copy(points.color, points.count, values);
    for (std::size_t i = 0; i < points.count; ++i)
        values.set(i, {surface.color.r, surface.color.g, surface.color.b});
}

void find_parameter(const ShownParameter& shown, const SurfaceModels& surface, const SurfacePoints& points,
                    const Vec3Span& values) {
    for (std::size_t i = 0; i < points.count; ++i) values.set(i, shown.value);
    const MaterialTextures& textures = surface.material_textures;
    const auto first = textures.numbers.begin(), end = first + static_cast<std::ptrdiff_t>(textures.of_model);
    const auto is_shown = [&](const TexturedNumber& number) { return number.parameter == shown.index; };
    const bool is_single = std::count_if(first, end, is_shown) == 1;
    const std::array channels{values.x, values.y, values.z};
    for (auto number = first; number != end; ++number) {
        if (!is_shown(*number)) continue;
        const float* const textured = points.parameters[static_cast<std::size_t>(number - first)].data();
        for (std::size_t c = 0; c < channels.size(); ++c)
            if (is_single || c == number->channel) std::copy_n(textured, points.count, channels[c]);
    }
}

}  // namespace

void SurfaceShader::find_term(Term term, const ShownParameter& parameter, const SurfaceModels& surface,
                              const ShadedObject& object, const SurfacePoints& points,
                              const Vec3Span& values) {
    shade(surface, object, points, values);
    switch (term) {
        case Term::intensity:
            return;
        case Term::ambient:
        case Term::diffuse:
        case Term::specular:
            add_up(surface, object, points, lights_, Checking::none);
            return copy(term == Term::ambient   ? ambient_
                        : term == Term::diffuse ? diffuse_
                                                : specular_,
                        points.count, values);
        case Term::surroundings:
            add_up(surface, object, points, {}, Checking::none);
            return copy(specular_, points.count, values);
        case Term::emission:
            return find_emission(surface, points, points.count, values);
        case Term::n_dot_l:
            return find_n_dot_l(points, values);
        case Term::visibility:
            return find_visibility(points, values);
        case Term::ambient_occlusion:
            return find_ambient_visibility(points, values);
        case Term::normal:
            return copy(normal_, points.count, values);
        case Term::color:
            return find_color(surface, points, values);
        case Term::parameter:
            return find_parameter(parameter, surface, points, values);
        default:
            throw std::invalid_argument("SurfaceShader::find_term(): this term does not depend on light");
    }
}

void SurfaceShader::find_n_dot_l(const SurfacePoints& points, const Vec3Span& values) {
    const ConstVec3Span normal = std::as_const(normal_).span(), to_light = std::as_const(to_light_).span();
    int samples = 0;
    std::fill_n(values.x, points.count, 0.0f);
    for (const RenderLight* const source : lights_) {
        for (int sample = 0; sample < source->light->sample_count(); ++sample, ++samples) {
            illuminate(*source, sample, points, points.filled);
            for (std::size_t i = 0; i < points.count; ++i) values.x[i] += dot(normal[i], to_light[i]);
        }
    }
    for (std::size_t i = 0; i < points.count; ++i) {
        const float mean = values.x[i] / static_cast<float>(std::max(samples, 1));
        values.set(i, {mean, mean, mean});
    }
}

void SurfaceShader::find_visibility(const SurfacePoints& points, const Vec3Span& values) {
    const ConstVec3Span normal = std::as_const(normal_).span(), to_light = std::as_const(to_light_).span();
    int samples = 0;
    clear(values, points.count);
    for (const RenderLight* const source : lights_) {
        for (int sample = 0; sample < source->light->sample_count(); ++sample, ++samples) {
            const auto shadowed = illuminate(*source, sample, points, points.filled);
            const ConstVec3Span left = shadowed ? visibility_->find(*shadowed) : ConstVec3Span{};
            for (std::size_t i = 0; i < points.count; ++i) {
                if (dot(normal[i], to_light[i]) > 0)
                    values.set(i, values[i] + (shadowed ? left[i] : Vec3{1, 1, 1}));
            }
        }
    }
    const float share = 1 / static_cast<float>(std::max(samples, 1));
    for (std::size_t i = 0; i < points.count; ++i) values.set(i, share * values[i]);
}

void SurfaceShader::find_ambient_visibility(const SurfacePoints& points, const Vec3Span& values) {
    int lights = 0;
    clear(values, points.count);
    for (const RenderLight* const source : lights_) {
        if (!has_shadows_ || source->ambient_occlusion.rays == 0) continue;
        const ConstVec3Span free = visibility_->find_ambient(source->ambient_occlusion);
        for (std::size_t i = 0; i < points.count; ++i) values.set(i, values[i] + free[i]);
        ++lights;
    }
    const float share = 1 / static_cast<float>(std::max(lights, 1));
    for (std::size_t i = 0; i < points.count; ++i)
        values.set(i, lights > 0 ? share * values[i] : Vec3{1, 1, 1});
}

}  // namespace candela
