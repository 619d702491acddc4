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
    if (cutoff > 0 && of.opacity_numbers.size() > 1)
        files.approximate(
            fmt::format("the opacity of object {} is cut off factor by factor", of.label).c_str());
    for (std::size_t i = 0; i < of.opacity_numbers.size(); ++i) {
        const std::string name =
            i == 0 ? fmt::format("opacity_{}.ppm", object) : fmt::format("opacity_{}_{}.ppm", object, i + 1);
        factors_.push_back({.pattern = "uv_mapping pigment_pattern { " +
                                       image_map_of(scene, of.opacity_numbers[i], name, files) + " }",
                            .clear = cutoff,
                            .full = cutoff > 0 ? cutoff : 1});
    }
    has_texture_ = !factors_.empty();
    if (has_texture_) return;
    const float full = cutoff > 0 ? 0 : of.opacity;  // below the cutoff it is absent
    factors_.push_back({.pattern = "average", .clear = 1 - full, .full = full});
}

std::string Cover::over(const std::string& texture) const {
    std::string covered = texture;
    for (const Factor& factor : factors_)
        covered = fmt::format(
            "{} texture_map {{ [{} pigment {{ rgbt 1 }} finish {{ ambient 0 diffuse 0 }}] [{} {}] }}",
            factor.pattern, factor.clear, factor.full, covered);
    return covered;
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
