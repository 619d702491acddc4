#include "lights.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <regex>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "candela/target/kernels.h"
#include "candela/target/literals.h"
#include "candela/target/mirror.h"
#include "candela/target/textures.h"
#include "shadows.h"

namespace candela::cpp_target {

using namespace target;

namespace {

/// The radiance maps of a model's lights.
std::string radiance_of(const ExportedScene& scene, std::size_t model) {
    std::string maps;
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        const ExportedRadianceMap& map = scene.lights[i].radiance;
        if (scene.lights[i].model != model) continue;
        maps += fmt::format("    {{{}, {}, {}, {}}},\n", first_radiance_texel(scene, i), map.size,
                            last_radiance_level(map), float_text(map.density));
    }
    return fmt::format("const std::vector<RadianceMap> k_{}_radiance = {{\n{}}};\n\n",
                       scene.light_models[model].plugin->kernel.prefix, maps);
}

std::string constants(const ExportedScene& scene) {
    std::string text;
    for (std::size_t m = 0; m < scene.light_models.size(); ++m) {
        const ExportedModel& model = scene.light_models[m];
        const KernelText& kernel = model.plugin->kernel;
        std::string entries;
        std::size_t count = 0;
        for (const ExportedLight& light : scene.lights) {
            if (light.model != m) continue;
            ++count;
            if (has_parameters(model))
                entries += fmt::format("    {},  // {}\n", struct_text(model, light.values),
                                       ascii_identifier(light.label));
        }
        text += has_parameters(model) ? fmt::format("const std::vector<{}> k_{}_lights = {{\n{}}};\n\n",
                                                    constants_type(model), kernel.prefix, entries)
                                      : fmt::format("const int k_{}_lights = {};\n\n", kernel.prefix, count);
        if (is_mirrored(scene, m)) text += radiance_of(scene, m);
    }
    return text;
}

/// Whether the model's kernel has that function, which the descriptor need not list.
bool has_kernel_function(const ExportedModel& model, std::string_view name) {
    const KernelText& kernel = model.plugin->kernel;
    const std::regex declared(fmt::format(R"(\b{}_{}\s*\()", kernel.prefix, name));
    return std::regex_search(without_comments(kernel.text), declared);
}

/// The statements that add up the light of a model's lights.
class LightLoop {
  public:
    LightLoop(const ExportedScene& scene, std::size_t model) : model_(scene.light_models[model]) {
        for (const ExportedLight& light : scene.lights) {
            if (light.model != model) continue;
            const bool casts = scene.has_shadows && light.casts_shadows;
            ++(casts ? casting_ : others_);
            has_extents_ = has_extents_ || has_penumbras(scene, light);
            has_occlusion_ = has_occlusion_ || (scene.has_shadows && light.ambient_occlusion_rays > 0);
            const bool is_source =
                std::ranges::any_of(light.punctual, [](const auto& p) { return p.w != 0; });
            is_placed_ = is_placed_ || (casts && is_source);
        }
        has_occluded_objects_ = target::has_occlusion(scene);
        is_mirrored_ = target::is_mirrored(scene, model);
        if (has_extents_) require("extent");
        if (has_function(model_, "distance")) {
            is_placed_ = true;
        } else if (is_placed_) {
            require("punctual");
        }
    }

    /// How the single lights cast shadows, where they differ.
    std::string flags(const ExportedScene& scene, std::size_t model) const {
        std::string casts, occlusion;
        if (!is_mixed() && !has_occlusion_) return "";
        for (const ExportedLight& light : scene.lights) {
            if (light.model != model) continue;
            casts += fmt::format("{}{}", casts.empty() ? "" : ", ", light.casts_shadows);
            occlusion +=
                fmt::format("{}{{{}, {}}}", occlusion.empty() ? "" : ", ", light.ambient_occlusion_rays,
                            float_text(light.ambient_occlusion_distance));
        }
        std::string text;
        if (is_mixed())
            text += fmt::format("const std::vector<bool> {} = {{{}}};\n\n", named("casts_shadows"), casts);
        if (has_occlusion_)
            text += fmt::format("const std::vector<AmbientOcclusion> {} = {{{}}};\n\n", named("occlusion"),
                                occlusion);
        return text;
    }

    std::string text() const {
        std::string text = head();
        if (has_function(model_, "sample_count")) {
            text += fmt::format("        for (int k = 0; k < {}; ++k) {{\n",
                                call(model_, "sample_count", "light", "")) +
                    sample("            ", "k") + "        }\n";
        } else if (has_function(model_, "illuminate")) {
            text += sample("        ", "");
        }
        if (is_mirrored_)
            text += fmt::format(
                "        for (int k = 0; k < mirror_samples() && width > 0; ++k) {{\n"
                "            const MirrorSample m = mirror_sample({}[n], s.normal, s.to_observer, width, "
                "k);\n"
                "            sum += {}reflected(o, s, m.to_light).specular * m.intensity;\n        }}\n",
                named("radiance"), has_occluded_objects_ ? "o.occlusion * " : "");
        if (has_function(model_, "illuminate_ambient"))
            text +=
                fmt::format("        sum += {}{}reflected_ambient(o, s) * {};\n",
                            has_occluded_objects_ ? "o.occlusion * " : "",
                            has_occlusion_ ? fmt::format("open_part(at, {}[n]) * ", named("occlusion")) : "",
                            call(model_, "illuminate_ambient", "light", "r"));
        return text + "    }\n";
    }

  private:
    void require(const char* function) const {
        if (has_kernel_function(model_, function)) return;
        throw std::runtime_error(
            fmt::format("{} is data that its kernel does not describe (there is no function {}_{}), so a C++ "
                        "program cannot find its shadows",
                        model_.id, model_.plugin->kernel.prefix, function));
    }
    bool is_mixed() const { return casting_ > 0 && others_ > 0 && has_function(model_, "illuminate"); }
    std::string named(const char* what) const {
        return fmt::format("k_{}_{}", model_.plugin->kernel.prefix, what);
    }

    std::string head() const {
        const std::string lights = named("lights");
        if (!has_parameters(model_)) return fmt::format("    for (int n = 0; n < {}; ++n) {{\n", lights);
        const std::string type = constants_type(model_);
        if (!is_mixed() && !has_occlusion_ && !is_mirrored_)
            return fmt::format("    for (const {}& light : {}) {{\n", type, lights);
        return fmt::format(
            "    for (std::size_t n = 0; n < {0}.size(); ++n) {{\n        const {1}& light = {0}[n];\n",
            lights, type);
    }

    /// `index`: of the sample, if the light has several.
    std::string sample(const char* indent, const std::string& index) const {
        const auto arguments = [&](const std::string& first) {
            return index.empty() ? first : first + ", " + index;
        };
        std::string text, receiver = "r";
        if (has_extents_) {
            receiver = "from";
            const std::string moved =
                fmt::format("displaced(r, at, {}_extent({}), {})", model_.plugin->kernel.prefix,
                            arguments("light"), index.empty() ? "0" : index);
            text += fmt::format(
                "{}const Receiver from = {};\n", indent,
                is_mixed() ? fmt::format("{}[n] ? {} : r", named("casts_shadows"), moved) : moved);
        }
        text +=
            fmt::format("{0}const Incident i = {1};\n{0}const Reflected f = reflected(o, s, i.to_light);\n",
                        indent, call(model_, "illuminate", "light", arguments(receiver)));
        std::string own;
        if (is_mirrored_) {
            own = "own * ";
            text += fmt::format(
                "{0}const float own = width > 0 ? highlight_share(light_density({1}[n], "
                "radiance_place(i.to_light)), s.normal, s.to_observer, i.to_light, width) : 1.0f;\n",
                indent, named("radiance"));
        }
        if (casting_ == 0)
            return text +
                   fmt::format("{}sum += f.diffuse * i.diffuse + {}f.specular * i.specular;\n", indent, own);
        const std::string left = fmt::format("unblocked(at, i.to_light, {})", distance(receiver, arguments));
        return text + fmt::format(
                          "{}const float left = {};\n{}sum += left * (f.diffuse * i.diffuse + {}f.specular * "
                          "i.specular);\n",
                          indent,
                          is_mixed() ? fmt::format("{}[n] ? {} : 1.0f", named("casts_shadows"), left) : left,
                          indent, own);
    }

    template <class Arguments>
    std::string distance(const std::string& receiver, const Arguments& arguments) const {
        if (!is_placed_) return "k_infinitely_far";
        if (has_function(model_, "distance")) return call(model_, "distance", "light", arguments(receiver));
        return fmt::format("length({}_punctual({}).position - {}.position)", model_.plugin->kernel.prefix,
                           arguments("light"), receiver);
    }

    const ExportedModel& model_;
    int casting_ = 0, others_ = 0;  // lights that cast shadows, and those that do not
    bool has_extents_ = false, has_occlusion_ = false;
    bool is_mirrored_ = false;           // in highlights
    bool has_occluded_objects_ = false;  // by their materials
    bool is_placed_ = false;             // at a distance
};

std::string flags(const ExportedScene& scene) {
    std::string text;
    for (std::size_t m = 0; m < scene.light_models.size(); ++m) text += LightLoop(scene, m).flags(scene, m);
    return text;
}

std::string loops(const ExportedScene& scene) {
    std::string text;
    for (std::size_t m = 0; m < scene.light_models.size(); ++m) text += LightLoop(scene, m).text();
    if (has_mirror_images(scene)) text = "    const float width = highlight_width(o);\n" + text;
    return text.empty() ? "    (void)o, (void)s, (void)r;  // there are no lights\n" : text;
}

}  // namespace

LightTexts lights_of(const ExportedScene& scene) { return {constants(scene), flags(scene), loops(scene)}; }

}  // namespace candela::cpp_target
