#include "lights.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "candela/target/textures.h"
#include "json.h"

namespace candela::three_target {

namespace {

/// The number that shaders of any device have room for, since three.js keeps them in uniform variables.
constexpr std::size_t k_most_lights = 32;

float distance_to(const Box& box, Vec3 p) {
    const auto beyond = [](float low, float high, float x) { return std::max({low - x, 0.0f, x - high}); };
    return length(Vec3{beyond(box.low.x, box.high.x, p.x), beyond(box.low.y, box.high.y, p.y),
                       beyond(box.low.z, box.high.z, p.z)});
}

/// three.js fades by 1 / max(r^decay, 0.01).
struct Fading {
    int decay = 0;
    float scale = 1;    // the divisor of the intensity
    float nearest = 0;  // the distance from which the two are the same, in metres
};

std::optional<Fading> fading_of(const PunctualLight& light) {
    const int terms =
        (light.constant > 0 ? 1 : 0) + (light.linear > 0 ? 1 : 0) + (light.quadratic > 0 ? 1 : 0);
    if (terms != 1) return std::nullopt;
    if (light.constant > 0) return Fading{.decay = 0, .scale = light.constant, .nearest = 0};
    if (light.linear > 0) return Fading{.decay = 1, .scale = light.linear, .nearest = 0.01f};
    return Fading{.decay = 2, .scale = light.quadratic, .nearest = 0.1f};
}

/// Angle and penumbra of a smooth cone; false if three.js does not have that cone.
bool put_cone(const PunctualLight& light, Json& json) {
    constexpr float k_sharpest = 1e-4f;  // between the cosines, where a smoothstep is one
    const double outer = std::acos(std::clamp(double{light.cos_outer}, -1.0, 1.0));
    if (!light.is_smooth || !(light.cone_scale > 0) || 1 / light.cone_scale < k_sharpest ||
        outer > std::numbers::pi / 2)
        return false;
    const double inner = std::acos(std::clamp(light.cos_outer + 1.0 / light.cone_scale, -1.0, 1.0));
    json["type"] = "spot";
    json["angle"] = outer;
    json["penumbra"] = 1 - inner / outer;
    json["target"] = vector_json(light.position + light.axis);
    return true;
}

std::optional<Json> own_light(const PunctualLight& light, const std::vector<Box>& boxes) {
    const Rgb c = light.diffuse;
    // three.js's diffuse materials reflect with 1 / pi; Candela's do not.
    Json json = {{"color", {shortest(c.r), shortest(c.g), shortest(c.b)}},
                 {"intensity", std::numbers::pi},
                 {"position", vector_json(light.position)}};
    if (light.w == 0) {
        json["type"] = "directional";
        json["target"] = {0, 0, 0};
        return json;
    }
    const auto fading = fading_of(light);
    if (!fading || std::ranges::any_of(boxes, [&](const Box& box) {
            return distance_to(box, light.position) < fading->nearest;
        }))
        return std::nullopt;
    json["intensity"] = std::numbers::pi / fading->scale;
    json["decay"] = fading->decay;
    json["type"] = "point";
    if (light.has_cone && !put_cone(light, json)) return std::nullopt;
    return json;
}

}  // namespace

std::optional<Json> own_lights(const ExportedScene& scene, const std::vector<Box>& boxes) {
    if (scene.has_shadows || target::has_opacity(scene)) return std::nullopt;
    Json lights = Json::array();
    for (const ExportedLight& light : scene.lights) {
        if (!light.is_data) return std::nullopt;
        for (const PunctualLight& sample : light.punctual) {
            auto own = own_light(sample, boxes);
            if (!own || lights.size() == k_most_lights) return std::nullopt;
            lights.push_back(*std::move(own));
        }
    }
    return lights;
}

}  // namespace candela::three_target
