// Presets of materials, for models whose parameters have these names: About::presets.
#pragma once

#include <array>
#include <cstddef>
#include <iterator>

#include "candela/plugin/params.h"

namespace candela::sdk {

/// A material's parameters for OpenGL's fixed-function lighting, which is Blinn-Phong's.
struct ClassicMaterial {
    const char* name = "";
    float ambient[3] = {};
    float diffuse[3] = {};
    float specular[3] = {};
    float shininess = 0;  // of 128
};

inline constexpr ClassicMaterial k_classic_materials[] = {
    {"emerald",
     {0.0215f, 0.1745f, 0.0215f},
     {0.07568f, 0.61424f, 0.07568f},
     {0.633f, 0.727811f, 0.633f},
     0.6f},
    {"jade", {0.135f, 0.2225f, 0.1575f}, {0.54f, 0.89f, 0.63f}, {0.316228f, 0.316228f, 0.316228f}, 0.1f},
    {"obsidian",
     {0.05375f, 0.05f, 0.06625f},
     {0.18275f, 0.17f, 0.22525f},
     {0.332741f, 0.328634f, 0.346435f},
     0.3f},
    {"pearl", {0.25f, 0.20725f, 0.20725f}, {1.0f, 0.829f, 0.829f}, {0.296648f, 0.296648f, 0.296648f}, 0.088f},
    {"ruby",
     {0.1745f, 0.01175f, 0.01175f},
     {0.61424f, 0.04136f, 0.04136f},
     {0.727811f, 0.626959f, 0.626959f},
     0.6f},
    {"turquoise",
     {0.1f, 0.18725f, 0.1745f},
     {0.396f, 0.74151f, 0.69102f},
     {0.297254f, 0.30829f, 0.306678f},
     0.1f},
    {"brass",
     {0.329412f, 0.223529f, 0.027451f},
     {0.780392f, 0.568627f, 0.113725f},
     {0.992157f, 0.941176f, 0.807843f},
     0.21794872f},
    {"bronze",
     {0.2125f, 0.1275f, 0.054f},
     {0.714f, 0.4284f, 0.18144f},
     {0.393548f, 0.271906f, 0.166721f},
     0.2f},
    {"chrome", {0.25f, 0.25f, 0.25f}, {0.4f, 0.4f, 0.4f}, {0.774597f, 0.774597f, 0.774597f}, 0.6f},
    {"copper",
     {0.19125f, 0.0735f, 0.0225f},
     {0.7038f, 0.27048f, 0.0828f},
     {0.256777f, 0.137622f, 0.086014f},
     0.1f},
    {"gold",
     {0.24725f, 0.1995f, 0.0745f},
     {0.75164f, 0.60648f, 0.22648f},
     {0.628281f, 0.555802f, 0.366065f},
     0.4f},
    {"silver",
     {0.19225f, 0.19225f, 0.19225f},
     {0.50754f, 0.50754f, 0.50754f},
     {0.508273f, 0.508273f, 0.508273f},
     0.4f},
    {"black plastic", {0.0f, 0.0f, 0.0f}, {0.01f, 0.01f, 0.01f}, {0.5f, 0.5f, 0.5f}, 0.25f},
    {"red plastic", {0.0f, 0.0f, 0.0f}, {0.5f, 0.0f, 0.0f}, {0.7f, 0.6f, 0.6f}, 0.25f},
    {"white plastic", {0.0f, 0.0f, 0.0f}, {0.55f, 0.55f, 0.55f}, {0.7f, 0.7f, 0.7f}, 0.25f},
    {"yellow plastic", {0.0f, 0.0f, 0.0f}, {0.5f, 0.5f, 0.0f}, {0.6f, 0.6f, 0.5f}, 0.25f},
};

/// A metal's reflectance at normal incidence, linear, and the same as an sRGB colour.
struct MeasuredMetal {
    const char* name = "";
    float reflectance[3] = {};
    float color[3] = {};  // 0-255
};

inline constexpr MeasuredMetal k_measured_metals[] = {
    {"aluminium", {0.913f, 0.922f, 0.924f}, {245, 246, 246}},
    {"brass", {0.91f, 0.778f, 0.423f}, {245, 228, 174}},
    {"chromium", {0.549f, 0.556f, 0.554f}, {196, 197, 196}},
    {"copper", {0.955f, 0.638f, 0.538f}, {250, 209, 194}},
    {"gold", {1.0f, 0.782f, 0.344f}, {255, 229, 158}},
    {"iron", {0.562f, 0.565f, 0.578f}, {198, 198, 200}},
    {"nickel", {0.66f, 0.609f, 0.526f}, {212, 205, 192}},
    {"platinum", {0.673f, 0.637f, 0.585f}, {214, 209, 201}},
    {"silver", {0.972f, 0.96f, 0.915f}, {252, 250, 245}},
    {"titanium", {0.542f, 0.497f, 0.449f}, {194, 187, 179}},
};

constexpr PresetValue preset_value(const char* parameter, const float (&rgb)[3]) {
    return {.parameter = parameter, .value = {.number = {rgb[0], rgb[1], rgb[2]}}};
}
constexpr PresetValue preset_value(const char* parameter, float number) {
    return {.parameter = parameter, .value = {.number = {number}}};
}

/// The values of a classic material: ka, kd, ks and shininess of a white object, since ka and kd include its
/// colour.
inline constexpr auto k_classic_values = [] {
    std::array<std::array<PresetValue, 4>, std::size(k_classic_materials)> values{};
    for (std::size_t i = 0; i < values.size(); ++i) {
        const ClassicMaterial& m = k_classic_materials[i];
        values[i] = {preset_value("ka", m.ambient), preset_value("kd", m.diffuse),
                     preset_value("ks", m.specular), preset_value("shininess", 128 * m.shininess)};
    }
    return values;
}();

/// For models with ka, kd, ks and shininess. Some emit more light than they receive, as they did in OpenGL.
inline constexpr auto k_classic_presets = [] {
    std::array<PresetSpec, std::size(k_classic_materials)> presets{};
    for (std::size_t i = 0; i < presets.size(); ++i) {
        presets[i] = {.name = k_classic_materials[i].name,
                      .source =
                          "Kilgard (1994), teapots.c, OpenGL's materials, in Woo, Neider, Davis (1997), "
                          "OpenGL programming guide",
                      .values = k_classic_values[i],
                      .has_color = true,
                      .color = {255, 255, 255}};
    }
    return presets;
}();

/// The values of a metal: no diffuse reflection, and its reflectance as ks. With an index of refraction of
/// 100, Fresnel's factor is at least 0.96, and nearly equal at all angles.
inline constexpr auto k_metal_values = [] {
    std::array<std::array<PresetValue, 3>, std::size(k_measured_metals)> values{};
    for (std::size_t i = 0; i < values.size(); ++i) {
        values[i] = {preset_value("kd", 0.0f), preset_value("ks", k_measured_metals[i].reflectance),
                     preset_value("ior", 100.0f)};
    }
    return values;
}();

/// For models with kd, ks and ior; roughness is unchanged.
inline constexpr auto k_metal_presets = [] {
    std::array<PresetSpec, std::size(k_measured_metals)> presets{};
    for (std::size_t i = 0; i < presets.size(); ++i) {
        const MeasuredMetal& m = k_measured_metals[i];
        presets[i] = {.name = m.name,
                      .source = "Akenine-Möller et al. (2018), Real-time rendering, 4th edition, table 9.2",
                      .values = k_metal_values[i],
                      .has_color = true,
                      .color = {m.color[0], m.color[1], m.color[2]}};
    }
    return presets;
}();

}  // namespace candela::sdk
