#include "opacity.h"

#include <fmt/format.h>

#include "candela/target/textures.h"
#include "pigment.h"

namespace candela::povray_target {

namespace {

/// Texture statements, declared under a name.
std::string declared(const std::string& name, const std::string& textures) {
    return fmt::format("#declare {} =\n{}", name, textures);
}

}  // namespace

Cover::Cover(const ExportedScene& scene, std::size_t object, FileSink& files) {
    const ExportedObject& of = scene.objects[object];
    if (!of.is_see_through()) return;
    cutoff_ = of.opacity_cutoff;
    if (cutoff_ > 0 && of.opacity_numbers.size() > 1)
        files.approximate(
            fmt::format("the opacity of object {} is cut off factor by factor", of.label).c_str());
    for (const ExportedTexturedNumber& number : of.opacity_numbers) {
        if (target::is_of_vertices(number)) {
            is_of_vertices_ = true;
            continue;
        }
        const std::string name = factors_.empty()
                                     ? fmt::format("opacity_{}.ppm", object)
                                     : fmt::format("opacity_{}_{}.ppm", object, factors_.size() + 1);
        factors_.push_back(
            {.pattern = "uv_mapping pigment_pattern { " + image_map_of(scene, number, name, files) + " }",
             .clear = cutoff_,
             .full = cutoff_ > 0 ? cutoff_ : 1});
    }
    has_texture_ = !factors_.empty();
    if (of.opacity_numbers.empty()) factors_.push_back(average(of.opacity, cutoff_));
}

/// Below the cutoff it is absent.
Cover::Factor Cover::average(float opacity, float cutoff) {
    const float full = cutoff <= 0 ? opacity : opacity >= cutoff ? 1.0f : 0.0f;
    return {.pattern = "average", .clear = 1 - full, .full = full};
}

std::string Cover::Factor::over(const std::string& texture) const {
    return fmt::format(
        "{} texture_map {{ [{} pigment {{ rgbt 1 }} finish {{ ambient 0 diffuse 0 }}] [{} {}] }}", pattern,
        clear, full, texture);
}

std::string Cover::over(const std::string& texture, std::optional<float> opacity) const {
    std::string covered = texture;
    for (const Factor& factor : factors_) covered = factor.over(covered);
    return opacity ? average(*opacity, cutoff_).over(covered) : covered;
}

Material Cover::over(const Material& material, const std::string& name, std::optional<float> opacity) const {
    if (is_opaque()) return material;
    const auto covering = [&](const char* statement, const std::string& of) {
        return fmt::format("    {} {{ {} }}\n", statement, over(of, opacity));
    };
    Material result{
        .declarations = declared(name, material.front), .front = covering("texture", name), .turned = {}};
    if (material.turned.empty()) return result;
    std::string turned = material.turned;
    const std::string interior = "interior_texture";
    turned.replace(turned.find(interior), interior.size(), "texture");
    result.declarations += declared(name + "_turned", turned);
    result.turned = covering("interior_texture", name + "_turned");
    return result;
}

const char* trace_level_text(const ExportedScene& scene) {
    return target::has_opacity(scene) ? "    max_trace_level 256\n" : "";
}

}  // namespace candela::povray_target
