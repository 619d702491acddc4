#include "lights.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>

#include "candela/target/renderers.h"
#include "placement.h"

namespace candela::gltf_target {

namespace {

constexpr const char* k_extension = "KHR_lights_punctual";

/// glTF renderers reflect with 1 / pi; Candela's models do not.
constexpr double k_candelas = std::numbers::pi;

std::string name_of(const ExportedLight& light) {
    const std::string_view label = light.label;
    const bool is_quoted = label.size() > 2 && label.front() == '\'' && label.back() == '\'';
    return std::string(is_quoted ? label.substr(1, label.size() - 2) : label);
}

/// The emitted light as a colour of at most 1 and an intensity; the light's own colour if it has the same
/// hue.
std::pair<Vec3, double> color_and_intensity(const ExportedModel& model, const ExportedValues& values,
                                            Rgb sent) {
    const double strongest = std::max({sent.r, sent.g, sent.b});
    if (!(strongest > 0)) return {{1, 1, 1}, 0};
    const auto intensity = [&](Vec3 color) { return strongest / std::max({color.x, color.y, color.z}); };
    if (const auto color = target::rgb_value(model, values, "color")) {
        const double own = intensity(*color);
        const auto is_near = [&](float a, float b) { return std::abs(own * a - b) <= 1e-6 * strongest; };
        if (std::isfinite(own) && is_near(color->x, sent.r) && is_near(color->y, sent.g) &&
            is_near(color->z, sent.b))
            return {*color, own};
    }
    const auto share = static_cast<float>(1 / strongest);
    return {{share * sent.r, share * sent.g, share * sent.b}, strongest};
}

/// glTF's outer cone is at most a right angle, and wider than the inner one.
Json cone_of(const PunctualLight& light) {
    const auto angle = [](double cosine) { return std::acos(std::clamp(cosine, -1.0, 1.0)); };
    const double width = light.cone_scale > 0 ? 1.0 / light.cone_scale : 0;
    const double outer = std::clamp(angle(light.cos_outer), 1e-4, std::numbers::pi / 2);
    const double inner = std::clamp(angle(light.cos_outer + width), 0.0, outer * (1 - 1e-6));
    return {{"innerConeAngle", inner}, {"outerConeAngle", outer}};
}

/// A view along a direction.
target::ViewAxes axes_along(Vec3 direction) {
    const Vec3 up = std::abs(direction.y) < 0.9f ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
    return target::axes_of({.position = {}, .look_at = direction, .up = up});
}

class Lights {
  public:
    Lights(const ExportedScene& scene, Document& document, Json& nodes, FileSink& files)
        : scene_(scene), document_(document), nodes_(nodes), files_(files) {}

    void add(const ExportedLight& light) {
        const std::string model = scene_.light_models[light.model].id;
        if (!light.is_data) return leave_out(model);
        if (scene_.has_shadows && !light.casts_shadows && !light.punctual.empty())
            files_.approximate("every light casts shadows, or none does");
        if (!(light.ambient == Rgb{})) leave_out(model);
        for (const PunctualLight& sample : light.punctual) add(light, sample, model);
    }
    Json taken() { return std::move(lights_); }

  private:
    void approximate(const std::string& model, const char* how) {
        files_.approximate(fmt::format("{} {}", model, how).c_str());
    }
    void leave_out(const std::string& model) {
        approximate(model, "has no counterpart in glTF and is left out");
    }

    void add(const ExportedLight& light, const PunctualLight& sample, const std::string& model) {
        if (!(sample.diffuse == sample.specular))
            approximate(model, "has highlights of its diffuse light's colour");
        const auto [color, strength] =
            color_and_intensity(scene_.light_models[light.model], light.values, sample.diffuse);
        double intensity = k_candelas * strength;
        Json node = {{"name", name_of(light)}};
        Json json = {{"name", name_of(light)}, {"color", {color.x, color.y, color.z}}};
        if (sample.w == 0) {
            json["type"] = "directional";
            node["matrix"] = placement(axes_along(-sample.position), {});
        } else {
            if (sample.constant > 0 || sample.linear > 0)
                approximate(model, "fades with the square of the distance");
            // Otherwise it is as bright at one metre.
            intensity /= static_cast<double>(sample.constant) + sample.linear + sample.quadratic;
            json["type"] = sample.has_cone ? "spot" : "point";
            if (sample.has_cone) {
                json["spot"] = cone_of(sample);
                node["matrix"] = placement(axes_along(sample.axis), sample.position);
                approximate(model, "falls off between its cones as the square of the cosine's share");
            } else {
                node["translation"] = {sample.position.x, sample.position.y, sample.position.z};
            }
        }
        json["intensity"] = intensity;
        lights_.push_back(std::move(json));
        node["extensions"][k_extension]["light"] = lights_.size() - 1;
        nodes_.push_back(document_.add("nodes", std::move(node)));
    }

    const ExportedScene& scene_;
    Document& document_;
    Json& nodes_;
    FileSink& files_;
    Json lights_ = Json::array();
};

}  // namespace

void add_lights(const ExportedScene& scene, Document& document, Json& nodes, FileSink& files) {
    Lights lights(scene, document, nodes, files);
    for (const ExportedLight& light : scene.lights) lights.add(light);
    Json list = lights.taken();
    if (list.empty()) return;
    document.use_extension(k_extension);
    document.root["extensions"][k_extension]["lights"] = std::move(list);
}

}  // namespace candela::gltf_target
