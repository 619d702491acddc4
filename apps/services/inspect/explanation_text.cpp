// Explanations as text.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <numbers>
#include <string>
#include <string_view>
#include <variant>

#include "inspect/explanation.h"

import candela.api;
import candela.util;

using candela::InspectedFragment;
using candela::LightTrace;
using candela::PointTrace;
using candela::Vec3;

namespace {

std::string text_of(Vec3 v) { return fmt::format("[{:.6g}, {:.6g}, {:.6g}]", v.x, v.y, v.z); }

std::string text_of(const std::vector<double>& numbers) {
    if (numbers.size() == 1) return fmt::format("{:.6g}", numbers[0]);
    if (numbers.empty()) return "a table";
    std::string result;
    for (const double number : numbers)
        result += fmt::format("{}{:.6g}", result.empty() ? "[" : ", ", number);
    return result + "]";
}

/// Where light is evaluated.
std::string_view place_of(candela::ShadingRate rate) {
    switch (rate) {
        case candela::ShadingRate::face:
            return "once per face: at its centroid";
        case candela::ShadingRate::vertex:
            return "once per vertex, and interpolated";
        default:
            return "once per pixel: here";
    }
}

class Writer {
  public:
    explicit Writer(const Explanation& explanation) : e_(explanation) {}

    std::string written() {
        const auto& image = e_.compiled.image;
        const auto& bytes = e_.pixel.bytes;
        line(0, fmt::format("pixel {},{} of {} x {}: {} {} {}", e_.x, e_.y, image.width, image.height,
                            bytes[0], bytes[1], bytes[2]));
        for (const InspectedFragment& fragment : e_.pixel.fragments) write(fragment);
        if (e_.pixel.background_weight > 0)
            value(0, "background", e_.pixel.background,
                  e_.pixel.background_weight < 1
                      ? fmt::format("{:.4g} of the pixel", e_.pixel.background_weight)
                      : "no object is visible");
        if (e_.pixel.fragments.size() + (e_.pixel.background_weight > 0 ? 1 : 0) > 1)
            value(0, "I", e_.pixel.intensity, "the sum, weighted by share of the pixel");
        line(0, fmt::format("luminance = {:.6g} cd/m²", e_.luminance()));
        write_encoding();
        if (!e_.why_no_steps().empty()) line(0, "note: " + e_.why_no_steps());
        if (const auto difference = e_.kernel_difference())
            line(0, fmt::format(
                        "the steps come from the kernels' text, compiled here; plugin and text differ by "
                        "{:.1g} of the intensity",
                        *difference));
        return candela::printable(text_, candela::LineBreaks::kept);
    }

  private:
    void line(int indent, const std::string& text) {
        text_ += std::string(static_cast<std::size_t>(2 * indent), ' ') + text + "\n";
    }
    void value(int indent, std::string_view name, Vec3 v, const std::string& remark = {}) {
        line(indent, fmt::format("{} = {}{}{}", name, text_of(v), remark.empty() ? "" : "  ", remark));
    }

    void write(const InspectedFragment& fragment) {
        const candela::Object& object = e_.scene.objects[fragment.object];
        line(0,
             fmt::format("object {}, {}: triangle {}, barycentric {}{}", object.label.text(),
                         object.shape.name, fragment.triangle, text_of(fragment.barycentric),
                         fragment.weight < 1 ? fmt::format(", {:.4g} of the pixel", fragment.weight) : ""));
        value(1, "p", fragment.position, "metres");
        line(1, fmt::format("{} shading: light is evaluated {}",
                            candela::shown_model_name(object.shading.name), place_of(fragment.rate)));
        for (std::size_t i = 0; i < fragment.points.size(); ++i) {
            if (fragment.points.size() > 1) line(1, fmt::format("vertex {}", i + 1));
            write(fragment.points[i], object, fragment.object);
        }
        if (fragment.points.size() > 1) value(1, "I", fragment.intensity, "interpolated");
        write_opacity(fragment, object);
    }

    /// How much the surface covers, if something may be seen through it or it is seen through others.
    void write_opacity(const InspectedFragment& fragment, const candela::Object& object) {
        const candela::SurfaceModels& surface = e_.compiled.objects[fragment.object].surface;
        if (!surface.is_see_through() && fragment.layer == 0) return;
        std::string remark;
        if (!candela::uniform_opacity(surface)) {
            for (const candela::ParameterTexture& factor : object.common.textures) {
                if (factor.parameter != "opacity") continue;
                remark += remark.empty() ? "  " : " times ";
                remark += factor.attribute.empty()
                              ? "texture " + std::filesystem::path(factor.file).filename().string()
                              : attribute_text(factor);
            }
        }
        if (surface.opacity_cutoff > 0)
            remark +=
                fmt::format("{}opacity_cutoff {:g}", remark.empty() ? "  " : ", ", surface.opacity_cutoff);
        if (fragment.layer > 0)
            remark += fmt::format("{}behind {} surface{}", remark.empty() ? "  " : ", ", fragment.layer,
                                  fragment.layer == 1 ? "" : "s");
        line(1, fmt::format("opacity = {:.6g}{}", fragment.opacity, remark));
    }

    /// The material's parameters that have textures, and where in the pictures the point is.
    void write_textures(const PointTrace& point, const candela::Object& object,
                        const candela::MaterialTextures& textures) {
        for (const candela::ParameterTexture& texture : object.textures) {
            const std::size_t index = object.reflection.parameters.index_of(texture.parameter);
            const candela::Parameter& parameter = object.reflection.parameters.schema()[index];
            std::string value;
            const candela::TexturedNumber* number = nullptr;
            for (std::size_t i = 0; i < point.parameters.size(); ++i) {
                const candela::VaryingValue& own = point.parameters[i];
                if (own.parameter != index) continue;
                const float unit = parameter.unit == "deg" ? 180 / std::numbers::pi_v<float> : 1.0f;
                value += fmt::format("{}{:.6g}", value.empty() ? "" : ", ", unit * own.value);
                number = &textures.numbers[i];
            }
            if (number == nullptr) continue;
            if (parameter.type != candela::ParamType::real) value = fmt::format("[{}]", value);
            line(2, fmt::format("{} = {}  {}", texture.parameter, value,
                                source_text(texture, textures, *number, point)));
        }
    }

    void write_normal_map(const PointTrace& point, const candela::NormalMap& map,
                          const candela::PlacedTexture& picture) {
        const Vec3 t = point.normal_texel;
        const Vec3 meaning = map.has_heights ? Vec3{t.x - candela::k_level, t.y - candela::k_level, 0}
                                             : 2.0f * t - Vec3{1, 1, 1};
        value(2, map.has_heights ? "slopes" : "mapped", meaning, texel_text(map.file, picture, point));
        value(2, "N", point.normal,
              map.has_heights ? "N_shading, tilted by the slopes" : "N_shading, tilted");
    }

    static std::string attribute_text(const candela::ParameterTexture& texture) {
        return fmt::format("attribute {} of the vertices", texture.attribute);
    }

    /// Where a number of the material comes from.
    static std::string source_text(const candela::ParameterTexture& texture,
                                   const candela::MaterialTextures& textures,
                                   const candela::TexturedNumber& number, const PointTrace& point) {
        if (!texture.attribute.empty()) return attribute_text(texture);
        return texel_text(texture.file, textures.textures[number.texture], point);
    }

    static std::string texel_text(const std::string& file, const candela::PlacedTexture& placed,
                                  const PointTrace& point) {
        const bool is_second = placed.placing.uv != 0;
        const std::array<int, 2> texel = placed.texel_at(is_second ? point.second_uv[0] : point.u,
                                                         is_second ? point.second_uv[1] : point.v);
        return fmt::format("texel ({}, {}) of {}", texel[0], texel[1],
                           std::filesystem::path(file).filename().string());
    }

    /// The keys of every material, if the object has them.
    void write_common(const PointTrace& point, const candela::Object& object,
                      const candela::SurfaceModels& surface) {
        const candela::MaterialTextures& textures = surface.material_textures;
        const auto remark = [&](const char* parameter, std::size_t first) {
            const auto texture =
                std::ranges::find(object.common.textures, parameter, &candela::ParameterTexture::parameter);
            if (texture == object.common.textures.end()) return std::string();
            return source_text(*texture, textures, textures.numbers[first], point);
        };
        if (surface.is_occluded()) {
            const std::string texel = remark("occlusion", textures.occlusion);
            line(2, fmt::format("occlusion = {:.6g}{}{}", point.occlusion, texel.empty() ? "" : "  ", texel));
        }
        if (!surface.emits()) return;
        std::string source = remark("emission", textures.emission);
        if (object.common.emission_strength != 1)
            source += fmt::format("{}emission_strength {:g}", source.empty() ? "" : ", ",
                                  object.common.emission_strength);
        value(2, "I_e", point.emission, source.empty() ? "emission" : "emission: " + source);
    }

    void write(const PointTrace& point, const candela::Object& object, std::size_t object_index) {
        value(2, "p", point.position);
        const candela::SurfaceModels& surface = e_.compiled.objects[object_index].surface;
        const candela::MaterialTextures& textures = surface.material_textures;
        const char* const reversed = point.from_behind ? "seen from behind: reversed" : "";
        if (textures.normal) {
            value(2, "N_shading", point.shading_normal, reversed);
            steps(3, e_.normal_steps(point));
            write_normal_map(point, *object.normal_map, textures.textures[textures.normal->texture]);
        } else {
            value(2, "N", point.normal, reversed);
            steps(3, e_.normal_steps(point));
        }
        value(2, "V", point.to_observer);
        if (length(point.tangent) > 0) value(2, "T", point.tangent);
        value(2, "C_o", point.color,
              object.color_texture
                  ? source_text(*object.color_texture, textures, textures.numbers[textures.color], point)
                  : "");
        write_textures(point, object, textures);
        write_common(point, object, surface);
        for (const LightTrace& light : point.lights) write(light, point, object);
        if (length(point.surroundings) > 0) value(2, "surroundings", point.surroundings);
        value(2, "I_a", point.ambient);
        value(2, "I_d", point.diffuse);
        value(2, "I_s", point.specular);
        value(2, "I", point.intensity, surface.emits() ? "I_a + I_d + I_s + I_e" : "I_a + I_d + I_s");
    }

    void write(const LightTrace& light, const PointTrace& point, const candela::Object& object) {
        const candela::LightSource& source = e_.scene.lights[light.light];
        const bool is_ambient = light.sample == LightTrace::k_ambient;
        line(2,
             fmt::format("light {}, {}{}", source.label.text(), candela::shown_model_name(source.model.name),
                         light.sample == LightTrace::k_mirrored ? ", its mirror image in the highlight"
                         : light.sample > 0                     ? fmt::format(", sample {}", light.sample)
                                                                : ""));
        if (light.sample == LightTrace::k_mirrored) return value(3, "I_s", light.reflected_specular);
        write_photometry(source);
        if (is_ambient) {
            write_visibility(light);
            value(3, "arriving", light.diffuse);
        } else {
            const Vec3 n = point.normal, l = light.to_light, v = point.to_observer;
            const Vec3 half = l + v;
            value(3, "L", l, fmt::format("N.L = {:.6g}", dot(n, l)));
            const Vec3 r = 2 * dot(n, l) * n - l;
            value(3, "R", r, fmt::format("R.V = {:.6g}", dot(r, v)));
            if (length(half) > 0) {
                const Vec3 h = (1 / length(half)) * half;
                value(3, "H", h, fmt::format("N.H = {:.6g}", dot(n, h)));
            }
            write_visibility(light);
            value(3, "arriving", light.diffuse);
            if (light.specular != light.diffuse) value(3, "arriving, for highlights", light.specular);
        }
        steps(4, e_.light_steps(light));
        line(3, fmt::format("{} reflection", candela::shown_model_name(object.reflection.name)));
        steps(4, e_.reflection_steps(light));
        if (is_ambient) return value(3, "I_a", light.reflected_ambient);
        value(3, "I_d", light.reflected_diffuse);
        value(3, "I_s", light.reflected_specular);
    }

    /// The values that the author wrote for a light's intensity and temperature, and the number that they
    /// make.
    void write_photometry(const candela::LightSource& source) {
        const auto written = source.written.find("intensity");
        if (written == source.written.end()) return;
        const double intensity = std::get<double>(source.model.parameters.get("intensity"));
        const std::string scale = source.temperature > 0
                                      ? fmt::format(" at {} K, for its brightest channel", source.temperature)
                                      : "";
        const bool has_unit = written->second.starts_with('"');
        line(3, fmt::format("intensity = {}{} is {:.6g}{}", written->second, scale, intensity,
                            has_unit ? ": candela or lux over pi, at 683 lm/W" : ""));
    }

    /// Whether shadows of surfaces may be partial. Transparent models are another reason.
    bool lets_light_through() const {
        return std::ranges::any_of(
                   e_.compiled.objects,
                   [](const candela::RenderObject& object) { return object.surface.is_see_through(); }) &&
               std::ranges::none_of(e_.compiled.objects, [](const candela::RenderObject& object) {
                   return object.surface.environment_reflection != nullptr;
               });
    }

    /// How much of the light is not blocked, and by what it is.
    void write_visibility(const LightTrace& light) {
        if (!e_.may_be_blocked(light)) return;
        std::string remark = light.visibility == Vec3{1, 1, 1} ? "nothing is in the way" : "";
        if (light.blocker) {
            const candela::Label& label = e_.scene.objects[light.blocker->object].label;
            remark = fmt::format("{} by object {}, triangle {}, at {:.6g} m",
                                 light.visibility == Vec3{} ? "blocked" : "partly blocked", label.text(),
                                 light.blocker->triangle, light.blocker->distance);
        } else if (light.visibility != Vec3{1, 1, 1} && lets_light_through()) {
            remark = "surfaces that are not opaque are in the way";
        }
        value(3, "visibility", light.visibility, remark);
    }

    /// Of the outermost function's arguments, shows only those not shown yet: its parameters.
    void steps(int indent, const std::vector<KernelValue>& values) {
        for (const KernelValue& value : values) {
            const KernelStep& step = *value.step;
            const int at = indent + value.depth + (step.kind == KernelStep::Kind::function ? 0 : 1);
            if (step.kind == KernelStep::Kind::function) {
                line(at, fmt::format("{}:{} {}()", step.file, step.line, step.name));
                continue;
            }
            const bool is_argument = step.kind == KernelStep::Kind::argument;
            if (is_argument && value.depth == 0 && is_shown(step.text)) continue;
            const std::string name = step.kind == KernelStep::Kind::result ? "result" : step.name;
            line(at, fmt::format("{}{} = {}{}", name, value.member, text_of(value.numbers),
                                 is_argument ? "" : fmt::format("    {};", step.text)));
        }
    }
    static bool is_shown(const std::string& argument) {
        constexpr std::array<std::string_view, 5> k_shown{"Surface ", "Receiver ", "ShadingPoint ",
                                                          "Triangle ", "vec3 to_light"};
        return std::ranges::any_of(k_shown,
                                   [&](std::string_view begin) { return argument.starts_with(begin); });
    }

    void write_encoding() {
        const Vec3 i = e_.pixel.intensity;
        const candela::DisplayTransform transform = candela::display_of(e_.compiled);
        const bool is_srgb = transform.encoding == candela::ColorEncoding::srgb;
        const candela::Rgb shown = candela::toned({i.x, i.y, i.z}, transform);
        const std::array<float, 3> intensities{i.x, i.y, i.z}, channels{shown.r, shown.g, shown.b};
        const bool has_tone = transform.tone != candela::ToneCurve::none;
        constexpr std::array<const char*, 3> k_names{"red", "green", "blue"};
        for (std::size_t c = 0; c < 3; ++c) {
            const float clamped = std::clamp(channels[c], 0.0f, 1.0f);
            const float encoded = is_srgb ? candela::linear_to_srgb(clamped) : clamped;
            std::string steps;
            if (transform.exposure != 1)
                steps += fmt::format(", exposed x {:.6g} = {:.6g}", transform.exposure,
                                     transform.exposure * intensities[c]);
            if (has_tone)
                steps += fmt::format(", tone {} {:.6g}", candela::name_of(transform.tone), channels[c]);
            line(0, fmt::format(
                        "{}: I = {:.6g}{}{}, {}{:.6g}, x 255 = {:.2f}, byte {}", k_names[c], intensities[c],
                        steps, clamped != channels[c] ? fmt::format(", clamped to {:g}", clamped) : "",
                        is_srgb ? "sRGB " : "not encoded ", encoded, 255 * encoded, e_.pixel.bytes[c]));
        }
    }

    const Explanation& e_;
    std::string text_;
};

}  // namespace

std::string explanation_text(const Explanation& explanation) { return Writer(explanation).written(); }
