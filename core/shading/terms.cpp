module;

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <utility>

module candela.shading;

import :guarded;
import :term;
import candela.api;
import candela.plugins;

namespace candela {

namespace {

void copy(const Vec3Arrays& from, std::size_t count, const Vec3Span& to) {
    std::copy_n(from.x.begin(), count, to.x);
    std::copy_n(from.y.begin(), count, to.y);
    std::copy_n(from.z.begin(), count, to.z);
}

}  // namespace

void SurfaceShader::find_term(Term term, const SurfaceModels& surface, const Interior& interior,
                              const SurfacePoints& points, const Vec3Span& values) {
    shade(surface, interior, points, values);
    switch (term) {
        case Term::intensity:
            return;
        case Term::ambient:
        case Term::diffuse:
        case Term::specular:
            add_up(surface, interior, points, lights_, Checking::none);
            return copy(term == Term::ambient   ? ambient_
                        : term == Term::diffuse ? diffuse_
                                                : specular_,
                        points.count, values);
        case Term::surroundings:
            add_up(surface, interior, points, {}, Checking::none);
            return copy(specular_, points.count, values);
        case Term::n_dot_l:
            return find_n_dot_l(points, values);
        case Term::normal:
            return copy(normal_, points.count, values);
        default:
            throw std::invalid_argument("SurfaceShader::find_term(): this term does not depend on light");
    }
}

void SurfaceShader::find_n_dot_l(const SurfacePoints& points, const Vec3Span& values) {
    const ReceiverBatch receivers{
        .count = points.filled, .position = points.position.span(), .normal = std::as_const(normal_).span()};
    const ConstVec3Span normal = std::as_const(normal_).span(), to_light = std::as_const(to_light_).span();
    int samples = 0;
    std::fill_n(values.x, points.count, 0.0f);
    for (const RenderLight* const source : lights_) {
        for (int sample = 0; sample < source->light->sample_count(); ++sample, ++samples) {
            guarded(PluginKind::light, source->plugin, [&] {
                source->light->illuminate(sample, receivers,
                                          {to_light_.span(), light_diffuse_.span(), light_specular_.span()});
            });
            for (std::size_t i = 0; i < points.count; ++i) values.x[i] += dot(normal[i], to_light[i]);
        }
    }
    for (std::size_t i = 0; i < points.count; ++i) {
        const float mean = values.x[i] / static_cast<float>(std::max(samples, 1));
        values.set(i, {mean, mean, mean});
    }
}

}  // namespace candela
