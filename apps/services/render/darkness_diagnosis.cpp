#include "render/darkness_diagnosis.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

import candela.api;
import candela.geometry;
import candela.raster;
import candela.render;
import candela.scene;
import candela.shading;
import candela.util;

namespace candela {

namespace {

/// The vector towards the observer, not unit.
Vec3 towards(const Camera& camera, Vec3 point) {
    return camera.projection == Projection::perspective ? camera.eye - point : -camera.forward;
}

std::string unseen(const RenderScene& scene, const Camera& camera) {
    bool any_ahead = false;
    for (const RenderObject& object : scene.objects) {
        const ConstVec3Span p = object.mesh.position.span();
        for (std::size_t i = 0; i < object.mesh.vertex_count() && !any_ahead; ++i)
            any_ahead = dot(p[i] - camera.eye, camera.forward) > 0;
    }
    const Mesh& first = scene.objects.front().mesh;
    const Box around = box_around(first.position.span(), first.vertex_count());
    const Vec3 middle = 0.5f * (around.low + around.high);
    const std::string towards_first = fmt::format("object {} is around [{:.3g}, {:.3g}, {:.3g}]",
                                                  scene.objects.front().label, middle.x, middle.y, middle.z);
    return any_ahead ? "no object is within the view, or none is as large as a pixel; " + towards_first
                     : "the observer looks away from all objects; " + towards_first;
}

/// The light that arrives at the centroids of the faces turned towards the observer.
struct Received {
    float ambient = 0;
    float sent = 0;   // from any direction
    float faced = 0;  // from in front of the face
};

float largest(Vec3 v) { return std::max({v.x, v.y, v.z}); }

class Receivers {
  public:
    Receivers() {
        for (Vec3Arrays* const arrays : {&position_, &normal_, &to_light_, &diffuse_, &specular_})
            arrays->resize(k_size);
    }

    void add(const Mesh& mesh, std::size_t triangle, const Camera& camera, const RenderScene& scene) {
        const ConstVec3Span p = mesh.position.span();
        const Vec3 centroid =
            (1 / 3.0f) * (p[mesh.indices[3 * triangle]] + p[mesh.indices[3 * triangle + 1]] +
                          p[mesh.indices[3 * triangle + 2]]);
        Vec3 normal = mesh.face_normal.span()[triangle];
        if (dot(normal, towards(camera, centroid)) <= 0) {
            if (mesh.closed) return;
            normal = -normal;
        }
        position_.span().set(count_, centroid);
        normal_.span().set(count_, normal);
        if (++count_ == k_size) flush(scene);
    }

    void flush(const RenderScene& scene) {
        const ReceiverBatch batch{.count = count_,
                                  .position = ConstVec3Span(position_.span()),
                                  .normal = ConstVec3Span(normal_.span())};
        for (const RenderLight& source : scene.lights) {
            for (int sample = 0; sample < source.light->sample_count(); ++sample) {
                source.light->illuminate(sample, batch,
                                         {to_light_.span(), diffuse_.span(), specular_.span()});
                for (std::size_t i = 0; i < count_; ++i) {
                    const float sent = std::max(largest(diffuse_.span()[i]), largest(specular_.span()[i]));
                    received.sent = std::max(received.sent, sent);
                    if (dot(normal_.span()[i], to_light_.span()[i]) > 0)
                        received.faced = std::max(received.faced, sent);
                }
            }
            if (!source.has_ambient) continue;
            source.light->illuminate_ambient(batch, diffuse_.span());
            for (std::size_t i = 0; i < count_; ++i)
                received.ambient = std::max(received.ambient, largest(diffuse_.span()[i]));
        }
        count_ = 0;
    }

    Received received;

  private:
    static constexpr std::size_t k_size = 256;
    Vec3Arrays position_, normal_, to_light_, diffuse_, specular_;
    std::size_t count_ = 0;
};

Received received_in(const RenderScene& scene, const Camera& camera) {
    Receivers receivers;
    for (const RenderObject& object : scene.objects) {
        for (std::size_t t = 0; t < object.mesh.triangle_count(); ++t)
            receivers.add(object.mesh, t, camera, scene);
    }
    receivers.flush(scene);
    return receivers.received;
}

std::string unlit(const Received& r, bool has_shadows) {
    if (r.ambient == 0 && r.sent == 0) {
        return "no light reaches an object; check the intensities and colours of the lights, and the "
               "directions of spots";
    }
    if (r.ambient == 0 && r.faced == 0)
        return "every light is behind every face that the observer sees; move a light to the observer's side";
    if (has_shadows)
        return "the objects block all light that would reach a face, or reflect none of it; --no-shadows "
               "shows "
               "which";
    return "the objects reflect none of the light; check their colours, ka, kd and ks";
}

/// One digit, rounded up: "2000"; "4e+07".
std::string factor_text(float factor) {
    constexpr float k_longest = 1e6f;
    const float unit = std::pow(10.0f, std::floor(std::log10(factor)));
    const float rounded = unit * std::ceil(factor / unit);
    return rounded < k_longest ? fmt::format("{:.0f}", rounded) : fmt::format("{:.0e}", rounded);
}

/// The smallest intensity that is visible in 8 bits.
float darkest_visible(const RenderScene& scene, const Film& film) {
    if (film.view().pixels == PixelType::real) return 0;
    constexpr float k_half_a_step = 0.5f / 255;
    const float shown =
        film.view().encoding == ColorEncoding::srgb ? srgb_to_linear(k_half_a_step) : k_half_a_step;
    return shown / exposure_factor(scene.observer.exposure);
}

}  // namespace

std::string darkness_diagnosis(const RenderScene& scene, const Film& film,
                               const RenderStatistics& statistics) {
    if (scene.objects.empty() || scene.lights.empty()) return {};
    const float visible = darkest_visible(scene, film);
    if (statistics.pixels_shaded > 0 && statistics.brightest > visible) return {};
    const Camera camera = camera_of(scene.observer, film.width(), film.height());
    if (statistics.pixels_shaded == 0) return unseen(scene, camera);
    const Received received = received_in(scene, camera);
    if (statistics.brightest <= 0) return unlit(received, scene.occlusion.has_value());
    const float arriving = std::max(received.ambient, received.faced);
    // The tail of a highlight on an otherwise black surface: brighter lights would not help.
    constexpr float k_next_to_nothing = 1e-3f;
    if (statistics.brightest < k_next_to_nothing * arriving) {
        return fmt::format(
            "the objects reflect next to nothing ({1:.2g}) of light with intensity {0:.2g}; check their "
            "colours, ka, kd and ks",
            arriving, statistics.brightest);
    }
    const float exposure = exposure_factor(scene.observer.exposure);
    if (exposure != 1)
        return fmt::format(
            "the brightest point has intensity {:.2g}, and at this exposure a pixel below {:.2g} is black; "
            "with [observer] exposure = {:.1f} or less, that point is as bright as the display",
            statistics.brightest, visible, std::floor(10 * std::log2(statistics.brightest / 1.2f)) / 10);
    return fmt::format(
        "the brightest point has intensity {:.2g}, and a pixel below {:.2g} is black; multiply the lights' "
        "intensity by {} or more, or move them nearer",
        statistics.brightest, visible, factor_text(1 / statistics.brightest));
}

}  // namespace candela
