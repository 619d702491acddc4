#include "verify/edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

import candela.api;
import candela.raster;
import candela.scene;
import candela.shading;

using candela::Observer;
using candela::Projection;
using candela::Vec3;

namespace verify {

namespace {

constexpr float k_shift = 1.0f / 8;  // pixels; OpenGL may round vertices to a sixteenth

/// The observer (fitted to the picture), rotated or moved just enough to move the picture by (x, y) pixels.
Observer shifted(const Observer& observer, float x, float y, int height) {
    const Vec3 forward = observer.look_at - observer.position;
    const Vec3 right = candela::normalized(candela::cross(forward, observer.up));
    const Vec3 up = candela::normalized(candela::cross(right, forward));
    const auto rows = static_cast<float>(height);
    Observer result = observer;
    if (observer.projection == Projection::perspective) {
        const float half = 0.5f * observer.fov * std::numbers::pi_v<float> / 180;
        const float pixel = 2 * std::tan(half) / rows * candela::length(forward);
        result.look_at = observer.look_at - x * pixel * right + y * pixel * up;
    } else {
        const Vec3 move = observer.height / rows * (y * up - x * right);
        result.position = observer.position + move;
        result.look_at = observer.look_at + move;
    }
    return result;
}

/// In radians. Many times the effect of the last bits of floats on a direction, and too little to show in
/// anything continuous: a highlight with an exponent of 100 changes by a third of a level.
constexpr float k_turn = 2e-4f;

/// The ways to turn a light's directions: an angle about the direction itself, in radians.
constexpr std::array k_turns = {0.0f, 2 * std::numbers::pi_v<float> / 3, 4 * std::numbers::pi_v<float> / 3};

/// A light whose directions are turned by a small angle. Its intensity is unchanged.
class TurnedLight final : public candela::Light {
  public:
    /// `way`: as in k_turns; empty to leave the light unchanged. It may change between pictures.
    /// `data`: the light's, if it has any.
    TurnedLight(std::unique_ptr<candela::Light> light, std::optional<candela::LightData> data,
                const std::optional<float>& way)
        : light_(std::move(light)), data_(std::move(data)), way_(way) {}

    int sample_count() const noexcept override { return light_->sample_count(); }

    void illuminate(int sample, const candela::ReceiverBatch& receivers,
                    const candela::IncidentBatch& incident) const override {
        light_->illuminate(sample, receivers, incident);
        if (incident.distance != nullptr && data_) write_distances(sample, receivers, incident.distance);
        if (!way_) return;
        const float along = k_turn * std::cos(*way_), across = k_turn * std::sin(*way_);
        const candela::Vec3Span& to_light = incident.to_light;
        for (std::size_t i = 0; i < receivers.count; ++i) {
            const Vec3 l{to_light.x[i], to_light.y[i], to_light.z[i]};
            const Vec3 other = std::abs(l.x) < 0.7f ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
            const Vec3 u = candela::normalized(candela::cross(l, other));
            to_light.set(i, candela::normalized(l + along * u + across * candela::cross(l, u)));
        }
    }
    void illuminate_ambient(const candela::ReceiverBatch& receivers,
                            const candela::Vec3Span& ambient) const override {
        light_->illuminate_ambient(receivers, ambient);
    }
    std::unique_ptr<candela::Light> release() { return std::move(light_); }
    const std::optional<candela::LightData>& data() const { return data_; }

  private:
    /// Only their data say how far away such lights are.
    void write_distances(int sample, const candela::ReceiverBatch& receivers, float* distance) const {
        const candela::PunctualLight& light = data_->samples[static_cast<std::size_t>(sample)];
        if (light.w == 0) return;
        for (std::size_t i = 0; i < receivers.count; ++i)
            distance[i] = candela::length(light.position - receivers.position[i]);
    }

    std::unique_ptr<candela::Light> light_;
    std::optional<candela::LightData> data_;
    const std::optional<float>& way_;
};

/// The data of a light with an extent, moved by a small fraction of it: its samples vary within the extent
/// anyway, from pixel to pixel, which only the renderer can do. Three ways lie in no common plane.
candela::LightData moved(candela::LightData data, float way) {
    for (candela::PunctualLight& sample : data.samples) {
        const float size = candela::length(sample.extent_u) + candela::length(sample.extent_v);
        sample.position = sample.position + k_turn * size * Vec3{std::cos(way), std::sin(way), 1};
    }
    return data;
}

using Intensities = std::vector<float>;

/// Renders pictures of a scene with one sample per pixel. Restores the scene on destruction.
class Mover {
  public:
    Mover(candela::RenderScene& scene, const candela::Film& reference)
        : scene_(scene),
          reference_(reference),
          own_observer_(scene.observer),
          observer_(candela::fitted(scene.observer, reference.width(), reference.height())),
          samples_(scene.image.samples) {
        scene_.image.samples = 1;
        const bool varies = scene.occlusion && scene.shadow_pattern == candela::ShadowPattern::varied;
        for (candela::RenderLight& source : scene_.lights) {
            has_penumbras_.push_back(varies && source.casts_shadows && source.has_extent());
            auto turned =
                std::make_unique<TurnedLight>(std::move(source.light), std::move(source.data), way_);
            source.data.reset();
            turned_.push_back(turned.get());
            source.light = std::move(turned);
        }
    }
    Mover(const Mover&) = delete;
    Mover& operator=(const Mover&) = delete;
    ~Mover() {
        scene_.observer = own_observer_;
        scene_.image.samples = samples_;
        for (std::size_t i = 0; i < turned_.size(); ++i) {
            scene_.lights[i].data = turned_[i]->data();
            std::unique_ptr<candela::Light> own = turned_[i]->release();
            scene_.lights[i].light = std::move(own);
        }
    }

    /// The intensities at each pixel's point (x, y), measured from its top left. `way`: how the lights'
    /// directions are turned, if at all.
    Intensities seen_at(float x, float y, std::optional<float> way = std::nullopt) {
        way_ = way;
        for (std::size_t i = 0; i < turned_.size(); ++i) {
            if (!has_penumbras_[i]) continue;
            const candela::LightData& own = *turned_[i]->data();
            scene_.lights[i].data = way ? moved(own, *way) : own;
        }
        scene_.observer = shifted(observer_, 0.5f - x, 0.5f - y, reference_.height());
        candela::Film film(reference_.width(), reference_.height(), candela::PixelType::real,
                           scene_.image.color_management);
        candela::render(scene_, film, {});
        return {film.view().reals.begin(), film.view().reals.end()};
    }

  private:
    candela::RenderScene& scene_;
    const candela::Film& reference_;
    Observer own_observer_, observer_;
    int samples_;
    std::optional<float> way_;
    std::vector<TurnedLight*> turned_;
    std::vector<bool> has_penumbras_;  // whose samples vary, so that they remain data
};

/// The values in a picture's file, 0 to 255, before rounding.
Intensities levels_of(const Intensities& intensities, const candela::DisplayTransform& transform) {
    Intensities levels;
    levels.reserve(intensities.size());
    for (std::size_t i = 0; i + 2 < intensities.size(); i += 3) {
        const candela::Rgb shown =
            candela::displayed({intensities[i], intensities[i + 1], intensities[i + 2]}, transform);
        for (const float channel : {shown.r, shown.g, shown.b}) levels.push_back(255 * channel);
    }
    return levels;
}

}  // namespace

std::vector<float> unrounded_image(const candela::RenderScene& scene) {
    const candela::DisplayTransform transform = candela::display_of(scene);
    candela::Film film(scene.image.width, scene.image.height, candela::PixelType::real, transform);
    candela::render(scene, film, {});
    return levels_of({film.view().reals.begin(), film.view().reals.end()}, transform);
}

Sensitivity sensitivity_of(candela::RenderScene& scene, const candela::Film& reference, float levels) {
    const auto pattern = candela::sample_pattern(scene.image.samples);
    const candela::DisplayTransform transform = candela::display_of(scene);
    const auto expected = reference.view().bytes;
    const float share = 1 / static_cast<float>(pattern.size());
    std::vector<float> change(expected.size()), mean(expected.size());
    // The views an eighth of a pixel to the left, to the right, above and below.
    std::array<Intensities, 2> beside_x, beside_y;
    for (auto* const means : {&beside_x, &beside_y})
        for (Intensities& each : *means) each.resize(expected.size());
    Mover mover(scene, reference);
    for (const candela::SamplePosition& sample : pattern) {
        const float x = static_cast<float>(sample.x) / 16, y = static_cast<float>(sample.y) / 16;
        const Intensities there = mover.seen_at(x, y);
        const Intensities levels_there = levels_of(there, transform);
        std::vector<float> largest(there.size());
        const auto note = [&](const Intensities& other) {
            for (std::size_t i = 0; i < there.size(); i += 3) {
                if (std::equal(&other[i], &other[i] + 3, &there[i])) continue;
                const candela::Rgb shown =
                    candela::displayed({other[i], other[i + 1], other[i + 2]}, transform);
                const std::array<float, 3> channels{shown.r, shown.g, shown.b};
                for (std::size_t c = 0; c < 3; ++c)
                    largest[i + c] =
                        std::max(largest[i + c], std::abs(255 * channels[c] - levels_there[i + c]));
            }
        };
        for (const float dx : {-k_shift, k_shift}) {
            for (const float dy : {-k_shift, k_shift}) {
                const Intensities nearby = mover.seen_at(x + dx, y + dy);
                Intensities& mean_x = beside_x[dx > 0 ? 1 : 0];
                Intensities& mean_y = beside_y[dy > 0 ? 1 : 0];
                for (std::size_t i = 0; i < there.size(); ++i) {
                    mean_x[i] += 0.5f * share * nearby[i];
                    mean_y[i] += 0.5f * share * nearby[i];
                }
                note(nearby);
            }
        }
        // A sliver may lie within that distance.
        for (const float near : {k_shift / 2, k_shift / 4}) {
            for (const float dx : {-near, near}) {
                for (const float dy : {-near, near}) note(mover.seen_at(x + dx, y + dy));
            }
        }
        for (const float way : k_turns) note(mover.seen_at(x, y, way));
        for (std::size_t i = 0; i < there.size(); ++i) {
            change[i] += share * largest[i];
            mean[i] += share * there[i];
        }
    }
    Sensitivity result{.edges = std::vector<bool>(expected.size() / 3, false),
                       .right = std::vector<float>(expected.size()),
                       .down = std::vector<float>(expected.size())};
    const Intensities levels_of_mean = levels_of(mean, transform);
    for (auto* const means : {&beside_x, &beside_y})
        for (Intensities& each : *means) each = levels_of(each, transform);
    const auto slope = [&](const std::array<Intensities, 2>& means, std::size_t i) {
        return (means[1][i] - means[0][i]) / (2 * k_shift);
    };
    for (std::size_t i = 0; i < expected.size(); ++i) {
        const float apart = std::abs(levels_of_mean[i] - static_cast<float>(expected[i]));
        if (change[i] > levels || apart > levels) result.edges[i / 3] = true;
        result.right[i] = slope(beside_x, i);
        result.down[i] = slope(beside_y, i);
    }
    return result;
}

candela::Film mask_of(const std::vector<bool>& edges, int width, int height) {
    candela::Film mask(width, height, candela::PixelType::byte, candela::ColorEncoding::none);
    mask.fill(0, 0, width, height, {0, 0, 0});
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const auto columns = static_cast<std::size_t>(width);
        if (edges[i])
            mask.fill(static_cast<int>(i % columns), static_cast<int>(i / columns), 1, 1, {1, 1, 1});
    }
    return mask;
}

}  // namespace verify
