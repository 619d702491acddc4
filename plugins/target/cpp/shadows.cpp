#include "shadows.h"

#include <algorithm>
#include <string>
#include <string_view>

#include "candela/embed.h"
#include "candela/target/kernels.h"
#include "objects.h"
#include "opacity.h"

CANDELA_EMBED(candela_cpp_shadows, CANDELA_SOURCE_DIR "/templates/shadows.h");
CANDELA_EMBED(candela_cpp_sample_offset, CANDELA_SOURCE_DIR "/templates/sample_offset.h");
CANDELA_EMBED(candela_cpp_penumbras, CANDELA_SOURCE_DIR "/templates/penumbras.h");
CANDELA_EMBED(candela_cpp_ambient_occlusion, CANDELA_SOURCE_DIR "/templates/ambient_occlusion.h");

namespace candela::cpp_target {

using namespace target;

namespace {

bool lights_below_horizon(const ExportedReflection& model) {
    return std::ranges::any_of(model.plugin->properties, [](const Property& property) {
        return std::string_view(property.name) == "lights-below-horizon";
    });
}

/// Whether a surface reflects light from a direction, as an expression.
std::string reflects(const ExportedScene& scene) {
    const auto count = std::ranges::count_if(scene.reflections, lights_below_horizon);
    if (count == std::ssize(scene.reflections)) return "true";
    std::string text = "dot(at.normal, to_light) > 0";
    for (const ExportedReflection& model : scene.reflections) {
        if (lights_below_horizon(model))
            text += " ||\n        at.object.reflection == Reflection::" + reflection_enumerator(model);
    }
    return text;
}

bool lights_vertices(const ExportedScene& scene) {
    return std::ranges::any_of(scene.objects, [&](const ExportedObject& object) {
        return cpp_target::lights_vertices(scene, object);
    });
}

constexpr const char* k_at_vertices =
    "    // At a vertex, where all its surfaces meet, further inside the object.\n"
    "    if (at.triangle < 0) shift += 2.0f * margin * along_surface(at, at.object.middle);\n";

std::string functions(const ExportedScene& scene) {
    const bool has_extents =
        std::ranges::any_of(scene.lights, [&](const auto& light) { return has_penumbras(scene, light); });
    const bool has_ambient_occlusion = std::ranges::any_of(
        scene.lights, [](const ExportedLight& light) { return light.ambient_occlusion_rays > 0; });
    Values values = opacity_of_shadows(scene);
    values.emplace_back("REFLECTS", reflects(scene));
    values.emplace_back("AT_VERTICES", lights_vertices(scene) ? k_at_vertices : "");
    std::string text = filled(candela_cpp_shadows, views_of(values)) + "\n";
    if (has_extents || (has_ambient_occlusion && scene.shadows_vary))
        text += std::string(candela_cpp_sample_offset) + "\n";
    if (has_extents) text += std::string(candela_cpp_penumbras) + "\n";
    if (has_ambient_occlusion) {
        const char* const offset = scene.shadows_vary ? "sample_offset(at, 0)" : "vec2(0.0f, 0.0f)";
        text += filled(candela_cpp_ambient_occlusion, {{"OFFSET", offset}}) + "\n";
    }
    return text;
}

}  // namespace

bool casts_shadows(const ExportedScene& scene) {
    return scene.has_shadows && std::ranges::any_of(scene.lights, [&](const ExportedLight& light) {
               const bool has_samples = has_function(scene.light_models[light.model], "illuminate");
               return (light.casts_shadows && has_samples) || light.ambient_occlusion_rays > 0;
           });
}

bool lights_vertices(const ExportedScene& scene, const ExportedObject& object) {
    return casts_shadows(scene) && scene.shadings[object.shading].rate == ShadingRate::vertex;
}

bool has_penumbras(const ExportedScene& scene, const ExportedLight& light) {
    return scene.has_shadows && scene.shadows_vary && light.casts_shadows &&
           std::ranges::any_of(light.punctual, [](const PunctualLight& sample) {
               return sample.extent_u != Vec3{} || sample.extent_v != Vec3{};
           });
}

Values shadow_texts(const ExportedScene& scene) {
    const bool is_there = casts_shadows(scene);
    const auto if_there = [&](const char* text) { return std::string(is_there ? text : ""); };
    return {
        {"SHADOWS", is_there ? functions(scene) : ""},
        {"SHADOW_MEMBERS", if_there("    bool casts_shadows = true, receives_shadows = true;\n"
                                    "    bool is_solid = true;  // closed, and nothing is inside\n") +
                               (lights_vertices(scene) ? "    vec3 middle;  // of the box around it\n" : "")},
        {"SHADOW_TREE", if_there("    const ShadowTree tree(objects);\n")},
        {"TREE_PARAMETER", if_there(", const ShadowTree& tree")},
        {"TREE_ARGUMENT", if_there(", tree")},
        {"PIXEL_PARAMETER", if_there(", const ShadowTree& tree, Pixel pixel")},
        {"PIXEL_ARGUMENT", if_there(", tree, pixel")},
        {"NO_PIXEL", if_there(", tree, {}")},
        {"AT_PARAMETER", if_there(", const ShadowTree& tree, Pixel pixel, int shadow_triangle")},
        {"AT_TRIANGLE", if_there(", tree, pixel, triangle")},
        {"AT_VERTEX", if_there(", tree, {}, -1")},
        {"THIS_PIXEL",
         if_there(", tree, {static_cast<std::uint32_t>(i % k_width), static_cast<std::uint32_t>(i / "
                  "k_width)}")},
        {"PLACE_PARAMETER", if_there(", const ShadowPlace& at")},
        {"PLACE",
         if_there(", {tree, o, place, s.normal, (is_back ? -1.0f : 1.0f) * point.face_normal, is_back, "
                  "pixel, shadow_triangle}")}};
}

}  // namespace candela::cpp_target
