#include "import/framing.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <unordered_map>

#include "import/scene_text.h"
#include "import/vectors.h"

namespace importing {

namespace {

constexpr double k_fov = 35;
constexpr double k_margin = 1.08;

}  // namespace

Vector Bounds::center() const { return 0.5 * (low + high); }

double Bounds::radius() const {
    const double r = 0.5 * length(high - low);
    return r > 0 ? r : 1;
}

double Bounds::tolerance() const { return 1e-5 * radius(); }

Camera camera_for(const Bounds& bounds, double aspect) {
    const Vector back = unit({0.55, 0.42, 1}), right = unit(cross({0, 1, 0}, back));
    const Vector up = cross(back, right);
    const double slope = std::tan(0.5 * k_fov * std::numbers::pi / 180) / k_margin;
    const Vector center = bounds.center();
    double distance = 0.5 * bounds.radius();
    for (int corner = 0; corner < 8; ++corner) {
        Vector p{};
        for (std::size_t k = 0; k < 3; ++k) p[k] = (corner >> k & 1) != 0 ? bounds.high[k] : bounds.low[k];
        p = p - center;
        distance = std::max({distance, dot(p, back) + std::abs(dot(p, up)) / slope,
                             dot(p, back) + std::abs(dot(p, right)) / (slope * aspect)});
    }
    return {.position = center + distance * back,
            .towards = -1 * back,
            .up = {0, 1, 0},
            .extent = k_fov,
            .aspect = aspect};
}

std::vector<Light> lights_for(const Camera& camera, double brightness) {
    const Vector back = -1 * unit(camera.towards);
    Vector right = unit(cross(camera.up, back));
    if (length(right) == 0) right = {1, 0, 0};
    const Vector up = cross(back, right);
    const auto from = [&](double x, double y, double z) { return -1 * unit(x * right + y * up + z * back); };
    Light key{.name = "key", .type = "directional"};
    key.color = {255, 244, 229};
    key.intensity = 1.6 * brightness;
    key.direction = from(-0.7, 0.9, 0.8);
    Light fill{.name = "fill", .type = "directional"};
    fill.color = {214, 228, 255};
    fill.intensity = 0.45 * brightness;
    fill.direction = from(0.9, 0.1, 0.6);
    Light sky{.name = "sky", .type = "ambient"};
    sky.color = {230, 238, 255};
    sky.intensity = 0.6 * brightness;
    return {key, fill, sky};
}

Light studio_for(const Camera& camera, double brightness) {
    Light studio{.name = "studio", .type = "studio"};
    studio.intensity = brightness;
    const double degrees = std::atan2(-camera.towards[0], -camera.towards[2]) * 180 / std::numbers::pi;
    studio.rotation = std::round(10 * degrees) / 10;
    return studio;
}

std::vector<Light> studio_with_key_for(const Camera& camera, double brightness) {
    std::vector<Light> lights = lights_for(camera, brightness);
    std::erase_if(lights, [](const Light& light) { return light.name == "fill"; });
    for (Light& light : lights) {
        light.color = {255, 255, 255};
        light.intensity = (light.type == "ambient" ? 0.3 : 0.5) * brightness;
    }
    lights.insert(lights.begin(), studio_for(camera, 0.5 * brightness));
    return lights;
}

double exposure_for(const std::vector<Light>& lights, const Bounds& bounds) {
    double sum = 0;
    for (const Light& light : lights) {
        const Vector way = light.position - bounds.center();
        const double distance = std::max(length(way), 0.5 * bounds.radius());
        const double strongest = *std::ranges::max_element(light.color) / 255;
        sum += strongest * light.intensity / (light.type == "directional" ? 1 : distance * distance);
    }
    constexpr double k_least = 0.2, k_most = 6, k_good = 1.6;
    if (!(sum > 0) || !std::isfinite(sum) || (sum >= k_least && sum <= k_most)) return 1;
    return k_good / sum;
}

bool separate(std::vector<Light>& lights, const Camera& camera, const Bounds& bounds) {
    const Vector view = length(camera.towards) > 0 ? unit(camera.towards) : Vector{0, 0, -1};
    const double tolerance = bounds.tolerance();
    std::unordered_map<std::string, int> used{{vector_text(camera.position, tolerance), 1}};
    bool has_moved = false;
    for (Light& light : lights) {
        if (!light.has_position()) continue;
        for (;;) {
            const int count = used[vector_text(light.position, tolerance)]++;
            if (count == 0) break;
            // Not away from the origin: nothing may be too far out.
            const double step = 1e-3 * count * std::max(bounds.radius(), length(light.position));
            light.position = light.position + (dot(light.position, view) > 0 ? -step : step) * view;
            has_moved = true;
        }
    }
    return has_moved;
}

Vector room_for(const Bounds& bounds, const Camera& camera, const std::vector<Light>& lights) {
    Vector half{};
    const auto contain = [&](Vector p) {
        for (std::size_t k = 0; k < 3; ++k) half[k] = std::max(half[k], std::abs(p[k]));
    };
    contain(bounds.low);
    contain(bounds.high);
    contain(camera.position);
    for (const Light& light : lights)
        if (light.has_position()) contain(light.position);
    const double largest = std::max({half[0], half[1], half[2]});
    const double least = largest > 0 ? 0.1 * largest : 1;  // even if everything is at the origin
    for (double& extent : half) extent = 2.1 * std::max(extent, least);
    return half;
}

}  // namespace importing
