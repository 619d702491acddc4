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
    const float cutoff = of.opacity_cutoff;
    if (!of.opacity_numbers.empty()) {
        has_texture_ = true;
        pattern_ =
            "uv_mapping pigment_pattern { " +
            image_map_of(scene, of.opacity_numbers.front(), fmt::format("opacity_{}.ppm", object), files) +
            " }";
        clear_ = cutoff;
        full_ = cutoff > 0 ? cutoff : 1;
        return;
    }
    pattern_ = "average";
    full_ = cutoff > 0 ? 0 : of.opacity;  // below the cutoff it is absent
    clear_ = 1 - full_;
}

std::string Cover::over(const std::string& texture) const {
    return fmt::format(
        "{} texture_map {{ [{} pigment {{ rgbt 1 }} finish {{ ambient 0 diffuse 0 }}] [{} {}] }}", pattern_,
        clear_, full_, texture);
}

Material Cover::over(const Material& material, const std::string& name) const {
    if (is_opaque()) return material;
    const auto covering = [&](const char* statement, const std::string& of) {
        return fmt::format("    {} {{ {} }}\n", statement, over(of));
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
