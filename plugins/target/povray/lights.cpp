#include "lights.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "candela/target/literals.h"
#include "text.h"

namespace candela::povray_target {

namespace {

// POV-Ray fades by 2 / (1 + (r / fade_distance)^fade_power), or not at all without fade_power.

/// For an attenuation of 1 / (quadratic r^2): that is 2 d^2 / r^2, except for 1 part in (r / d)^2.
constexpr const char* k_near = "Near";

struct Fading {
    std::string scale;  // the factor of the colour
    std::string keywords;
};

Fading fading_of(const PunctualLight& light, const std::string& model, FileSink& files) {
    const bool is_linear = light.linear > 0, is_quadratic = light.quadratic > 0;
    if (is_quadratic && (is_linear || light.constant > 0))
        files.approximate(fmt::format("{} fades with the square of the distance alone", model).c_str());
    if (is_quadratic)
        return {.scale = fmt::format(" / (2 * {0} * {0}{1})", k_near,
                                     light.quadratic == 1 ? "" : fmt::format(" * {}", light.quadratic)),
                .keywords = fmt::format("fade_distance {} fade_power 2", k_near)};
    if (is_linear) {
        // 1 / (c + l r) is (1 / c) / (1 + r / (c / l)); without c, a c too small to be visible is used.
        const float constant = std::max(light.constant, 1e-6f * light.linear);
        return {.scale = fmt::format(" / (2 * {})", constant),
                .keywords = fmt::format("fade_distance {} fade_power 1", constant / light.linear)};
    }
    return {.scale = light.constant == 1 ? "" : fmt::format(" / {}", light.constant), .keywords = ""};
}

/// POV-Ray's angles are also measured from the axis; tightness would be an additional power of the cosine.
std::string cone_of(const PunctualLight& light, const std::string& model, FileSink& files) {
    if (!light.has_cone) return "";
    if (!light.is_smooth)
        files.approximate(fmt::format("{} falls off between its cones as a smoothstep of the cosine, "
                                      "not linearly",
                                      model)
                              .c_str());
    const auto degrees = [](float cosine) {
        return std::acos(std::clamp(static_cast<double>(cosine), -1.0, 1.0)) * 180 / std::numbers::pi;
    };
    const Vec3 p = light.position, a = light.axis;
    const float width = light.cone_scale > 0 ? 1 / light.cone_scale : 0;
    return fmt::format(" spotlight point_at {} radius {:.9g} falloff {:.9g} tightness 0",
                       vector_text(target::Vector{double{p.x} + a.x, double{p.y} + a.y, double{p.z} + a.z}),
                       degrees(light.cos_outer + width), degrees(light.cos_outer));
}

/// `keywords`: at the end of the statement.
std::string light_text(const ExportedScene& scene, const PunctualLight& light, const std::string& model,
                       const std::string& keywords, FileSink& files) {
    // POV-Ray has no exposure, and light adds up: exposing its sources exposes the picture.
    const Rgb color = scene.image.exposure * light.diffuse;
    if (!(light.diffuse == light.specular))
        files.approximate(fmt::format("{} has highlights of its diffuse light's colour", model).c_str());
    const std::string rgb = rgb_text({color.r, color.g, color.b});
    if (light.w == 0) {
        // The light is outside the room, and behind all that may block it; its rays are parallel to the one
        // towards the origin.
        const float distance = 2 * std::max(length(scene.room), scene.has_shadows ? 5e5f : 100.0f);
        return fmt::format("light_source {{ {} {} parallel point_at <0, 0, 0>{} }}\n",
                           vector_text(distance * light.position), rgb, keywords);
    }
    const Fading fading = fading_of(light, model, files);
    return fmt::format("light_source {{ {} {}{}{}{}{}{} }}\n", vector_text(light.position), rgb, fading.scale,
                       fading.keywords.empty() ? "" : " ", fading.keywords, cone_of(light, model, files),
                       keywords);
}

}  // namespace

Vec3 ambient_of(const ExportedScene& scene) {
    Vec3 sum{};
    for (const ExportedLight& light : scene.lights)
        sum = sum + Vec3{light.ambient.r, light.ambient.g, light.ambient.b};
    return scene.image.exposure * sum;
}

std::string lights_text(const ExportedScene& scene, FileSink& files) {
    std::string text;
    bool needs_near = false;
    for (const ExportedLight& light : scene.lights) {
        const ExportedModel& model = scene.light_models[light.model];
        if (!light.is_data) {
            files.approximate(
                fmt::format("{} has no counterpart in POV-Ray and is left out", model.id).c_str());
            continue;
        }
        if (light.punctual.empty()) continue;
        const bool is_global = !scene.has_shadows || light.casts_shadows;
        text += fmt::format("\n// {}: {}\n", target::ascii_identifier(light.label),
                            target::ascii_identifier(model.plugin->name));
        for (const PunctualLight& sample : light.punctual) {
            if (is_global) text += light_text(scene, sample, model.id, "", files);
            needs_near = needs_near || (sample.w != 0 && sample.quadratic > 0);
        }
    }
    if (!needs_near) return text;
    return fmt::format(
               "\n// A light fades by 2 / (1 + (r / fade_distance)^fade_power). For 1 / r^2, fade_distance "
               "is less\n"
               "// than all distances, and the colour is multiplied accordingly.\n#declare {} = 1e-4;\n",
               k_near) +
           text;
}

std::string unblocked_lights_text(const ExportedScene& scene, const std::string& shell, bool are_all,
                                  FileSink& files) {
    std::string text;
    for (const ExportedLight& light : scene.lights) {
        if (light.casts_shadows && !are_all) continue;
        for (const PunctualLight& sample : light.punctual)
            text +=
                "    " + light_text(scene, sample, scene.light_models[light.model].id,
                                    fmt::format(" projected_through {{ object {{ {} }} }}", shell), files);
    }
    return text;
}

}  // namespace candela::povray_target
