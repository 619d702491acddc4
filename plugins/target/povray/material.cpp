#include "material.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string_view>

#include "candela/color.h"
#include "candela/target/renderers.h"
#include "candela/target/textures.h"
#include "pigment.h"
#include "text.h"
#include "vertex_values.h"

namespace candela::povray_target {

namespace {

/// The smallest factor to divide by.
constexpr float k_tiny = 1e-6f;

Vec3 at_least_tiny(Vec3 v) { return {std::max(v.x, k_tiny), std::max(v.y, k_tiny), std::max(v.z, k_tiny)}; }
Vec3 over(Vec3 a, Vec3 b) { return {a.x / b.x, a.y / b.y, a.z / b.z}; }

enum class HighlightKind : int { none, phong, blinn };

/// ka, kd and ks of POV-Ray's own models: kd N.L, and where N.L > 0 ks (R.V)^n or ks (N.H)^n.
struct Finish {
    Vec3 ambient{}, diffuse{}, specular{};
    HighlightKind kind = HighlightKind::none;
    float exponent = 0;
};

std::string highlight_text(const Finish& finish, float brightness) {
    switch (finish.kind) {
        case HighlightKind::phong:
            return fmt::format(" phong {} phong_size {}", brightness, finish.exponent);
        case HighlightKind::blinn:  // roughness is the reciprocal of the exponent, and 0 an exponent of 0
            return fmt::format(" specular {} roughness {}", brightness,
                               finish.exponent > 0 ? 1 / finish.exponent : 0);
        default:
            return "";
    }
}

/// A model that POV-Ray does not have: its diffuse part as Lambert's, its highlight as Blinn's.
void approximate(const ExportedReflection& model, const ExportedValues& values, Vec3 color, Finish& finish,
                 FileSink& files) {
    auto highlight = target::highlight_of(model, values);
    if (const auto principled = target::principled_of(model, values)) {
        const float dielectric = 1 - principled->metallic;
        finish.diffuse = dielectric * principled->base;
        highlight = {.specular = dielectric * principled->reflectance * Vec3{1, 1, 1} +
                                 principled->metallic * target::times(principled->base, color),
                     .alpha = principled->alpha,
                     .facets = 1};
    }
    if (std::string_view(model.id) == "reflection/specular-glossiness") {
        const Vec3 mirrored = highlight->specular;
        finish.diffuse = (1 - std::max({mirrored.x, mirrored.y, mirrored.z})) * Vec3{1, 1, 1};
    }
    if (!highlight) {
        files.approximate(fmt::format("{} becomes Lambert's diffuse light", model.id).c_str());
        return;
    }
    const float a2 = highlight->alpha * highlight->alpha;
    // At normal incidence facets reflect F D / 4, where D is 1 / alpha^2.
    finish.specular =
        highlight->facets > 0 ? highlight->facets / (4 * a2) * highlight->specular : highlight->specular;
    finish.kind = HighlightKind::blinn;
    finish.exponent = 2 / a2 - 2;
    files.approximate(
        fmt::format("{} becomes Lambert's diffuse light and Blinn's highlight of about the same width",
                    model.id)
            .c_str());
}

/// `color`: the object's.
Finish finish_of(const ExportedReflection& model, const ExportedValues& values, Vec3 color, FileSink& files) {
    const std::string_view id = model.id;
    const auto rgb = [&](const char* parameter, float otherwise) {
        return target::rgb_value(model, values, parameter).value_or(Vec3{otherwise, otherwise, otherwise});
    };
    Finish finish{.ambient = rgb("ka", 0), .diffuse = rgb("kd", 1)};
    if (id == "reflection/unlit") finish.diffuse = {};
    if (id == "reflection/lambert" || id == "reflection/unlit") return finish;
    const auto exponent = target::real_value(model, values, "shininess");
    if (!exponent || (id != "reflection/phong" && id != "reflection/blinn-phong")) {
        approximate(model, values, color, finish, files);
        return finish;
    }
    finish.specular = rgb("ks", 0);
    if (finish.specular == Vec3{}) return finish;
    finish.kind = id == "reflection/phong" ? HighlightKind::phong : HighlightKind::blinn;
    finish.exponent = *exponent;
    if (finish.kind == HighlightKind::phong && finish.exponent == 0)
        files.approximate("reflection/phong with a shininess of 0 has no highlight where R.V is negative");
    return finish;
}

/// The parts of a surface's texture statements.
struct Surface {
    Vec3 color{};
    float diffuse = 0;
    Vec3 ambient{}, emission{};  // factors of the colour
    std::string highlight{};
    Vec3 tint{1, 1, 1};  // of the highlight, through a layer that filters
    bool has_filter = false;
};

Surface surface_of(const ExportedScene& scene, const ExportedObject& object, Vec3 shade, FileSink& files) {
    const Rgb decoded_color = decoded(object.color, scene.image.color_management);
    const Vec3 color = target::times({decoded_color.r, decoded_color.g, decoded_color.b}, shade);
    const Finish finish =
        finish_of(scene.reflections[object.reflection], object.materials[object.reflection], color, files);
    Surface surface{
        .color = color, .diffuse = finish.diffuse.x, .ambient = object.occlusion * finish.ambient};
    if (!is_grey(finish.diffuse)) {
        const Vec3 share = at_least_tiny(finish.diffuse);
        surface.color = target::times(surface.color, share);
        surface.diffuse = 1;
        surface.ambient = over(surface.ambient, share);
    }
    const Rgb emission = scene.image.exposure * target::emission_of(object, scene.image.color_management);
    if (emission != Rgb{}) {
        if (are_of_pictures(object.color_numbers))
            throw std::runtime_error(fmt::format(
                "object {} emits light and has a texture of its colour, by which POV-Ray multiplies what a "
                "surface emits; remove one of them",
                object.label));
        surface.color = at_least_tiny(surface.color);
        surface.emission = over({emission.r, emission.g, emission.b}, surface.color);
    }
    if (finish.kind == HighlightKind::none) return surface;
    const bool is_white = is_grey(finish.specular);
    surface.highlight = highlight_text(finish, is_white ? finish.specular.x : 1);
    if (!is_white) {
        // POV-Ray's highlights have the light's colour; one of another colour is seen through a layer of that
        // colour.
        surface.tint = at_least_tiny(finish.specular);
        surface.has_filter = true;
    }
    return surface;
}

/// `from_behind`: lit only from there, without a highlight.
std::string layer_text(const Surface& surface, const Pigment& pigment, bool from_behind) {
    const std::string emission =
        surface.emission == Vec3{} ? ""
                                   : fmt::format(" emission {}", rgb_text(pigment.factor * surface.emission));
    return fmt::format("texture {{ pigment {{ {} }} finish {{ ambient {}{} diffuse {}{}{} }} }}",
                       pigment.text, rgb_text(pigment.factor * surface.ambient), emission,
                       from_behind ? "0, " : "", pigment.factor * surface.diffuse,
                       from_behind ? "" : surface.highlight);
}

std::string filter_text(const Surface& surface) {
    if (!surface.has_filter) return "";
    return fmt::format(
        "    // A layer whose colour filters the one below, whose pigment is divided by it: only the "
        "highlight keeps it.\n"
        "    texture {{ pigment {{ rgbf <{}, {}, {}, 1> }} finish {{ ambient 0 diffuse 0 }} }}\n",
        surface.tint.x, surface.tint.y, surface.tint.z);
}

std::string front_text(const Surface& surface, const Pigment& pigment) {
    return fmt::format("    {}\n{}", layer_text(surface, pigment, false), filter_text(surface));
}

std::string interior_text(const Surface& surface, const Pigment& pigment) {
    return fmt::format(
        "    // Where the normal points away from the observer, POV-Ray turns it round: the side that it "
        "calls the back is the front.\n    interior_{}\n",
        layer_text(surface, pigment, true));
}

}  // namespace

Material material_of(const ExportedScene& scene, std::size_t object, FileSink& files) {
    const Surface surface = surface_of(scene, scene.objects[object], {1, 1, 1}, files);
    const Pigment front = pigment_of(scene, object, over(surface.color, surface.tint), "", files);
    const Pigment behind =
        surface.has_filter ? pigment_of(scene, object, surface.color, "_behind", files) : front;
    return {.front = front_text(surface, front), .turned = interior_text(surface, behind)};
}

Material material_at_vertex(const ExportedScene& scene, std::size_t object, Vec3 color, FileSink& files) {
    const Surface surface = surface_of(scene, scene.objects[object], color, files);
    return {.front = front_text(surface, {rgb_text(over(surface.color, surface.tint))}),
            .turned = interior_text(surface, {rgb_text(surface.color)})};
}

}  // namespace candela::povray_target
