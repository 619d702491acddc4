#include "import/scene_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "import/vectors.h"

import candela.scene;
import candela.util;

namespace importing {

namespace {

constexpr int k_height = 600;

/// In six digits, or in all digits of single precision if those are off by more than `tolerance`.
std::string real(double x, double tolerance = std::numeric_limits<double>::infinity()) {
    std::string text = fmt::format("{:.6g}", x == 0 ? 0.0 : x);
    double six = 0;
    std::from_chars(text.data(), text.data() + text.size(), six);
    if (std::abs(six - x) > tolerance) text = fmt::format("{}", static_cast<float>(x));
    return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}
std::string color(const Vector& v) { return fmt::format("[{:.0f}, {:.0f}, {:.0f}]", v[0], v[1], v[2]); }

/// Rounds components close to zero to zero.
Vector direction(Vector v) {
    for (double& x : v) x = std::round(x * 1e5) / 1e5;
    return v;
}

class Writer {
  public:
    Writer(const Model& model, const Setting& setting) : model_(model), setting_(setting) {}

    std::string write() {
        text_ = fmt::format("# {}, imported by candela import.\n", candela::printable(setting_.file));
        for (const std::string& note : model_.notes)
            text_ += fmt::format("# Note: {}.\n", candela::printable(note));
        text_ += "version = 1\n";
        write_view();
        write_models();
        for (const Light& light : setting_.lights) write(light);
        for (const Part& part : model_.parts) write(part);
        if (setting_.frames > 0) write_animation();
        return std::move(text_);
    }

  private:
    void begin(std::string_view title) { text_ += fmt::format("\n{}\n", title); }
    void add(std::string_view key, std::string value) { entries_.emplace_back(key, std::move(value)); }
    void end() {
        std::size_t longest = 0;
        for (const auto& [key, value] : entries_) longest = std::max(longest, key.size());
        for (const auto& [key, value] : entries_) text_ += fmt::format("{:<{}} = {}\n", key, longest, value);
        entries_.clear();
    }

    void write_view() {
        begin("[room]");
        add("height", real(setting_.room[1]));
        add("width", real(setting_.room[0]));
        add("depth", real(setting_.room[2]));
        end();
        const Camera& camera = setting_.camera;
        begin("[observer]");
        add("position", vector_text(camera.position, setting_.tolerance));
        add("look_at", vector_text(setting_.look_at, setting_.tolerance));
        if (const Vector up = direction(camera.up); up != Vector{0, 1, 0}) add("up", vector_text(up));
        if (camera.is_orthographic) add("projection", "\"orthographic\"");
        add(camera.is_orthographic ? "height" : "fov", real(camera.extent));
        // Pictures of any other size show the same frame.
        const double aspect = camera.aspect > 0.1 && camera.aspect < 10 ? camera.aspect : 4.0 / 3;
        add("frame_aspect", real(std::floor(1e3 * aspect) / 1e3));
        if (setting_.exposure) add("exposure", fmt::format("{:.2f}", *setting_.exposure));
        end();
        begin("[image]");
        add("width", fmt::format("{}", std::lround(k_height * aspect)));
        add("height", fmt::format("{}", k_height));
        add("samples", "4");
        add("background", "[40, 43, 50]");
        end();
        begin("[constraints]");
        add("overlap", "\"allow\"");
        end();
        begin("[shadows]");
        add("enabled", "true");
        end();
    }

    void write_models() {
        const auto special = std::ranges::find_if(
            model_.materials, [](const Material& material) { return material.reflection != "phong"; });
        reflection_ = special == model_.materials.end() ? "phong" : special->reflection;
        begin("[shading]");
        add("model", "\"phong\"");
        end();
        begin("[reflection]");
        add("model", candela::toml_text(reflection_));
        end();
    }

    /// The name in the file if it is unique; otherwise with a number.
    std::string add_name(std::string name) {
        if (name.empty()) return {};
        std::string unique = name;
        for (int i = 2; !names_.insert(unique).second; ++i) unique = fmt::format("{} {}", name, i);
        add("name", candela::toml_text(unique));
        return unique;
    }

    void write_animation() {
        begin("[animation]");
        add("frames", fmt::format("{}", setting_.frames));
        end();
        write_tracks("observer", setting_.camera.tracks);
        for (std::size_t i = 0; i < setting_.lights.size(); ++i)
            write_tracks(path_of("light", light_names_, i), setting_.lights[i].tracks);
        for (std::size_t i = 0; i < model_.parts.size(); ++i)
            write_tracks(path_of("object", object_names_, i), model_.parts[i].tracks);
    }

    /// Its name if that is a single word that needs no quotes and is not a number.
    static std::string path_of(const char* kind, const std::vector<std::string>& names, std::size_t index) {
        const std::string& name = names[index];
        const auto is_letter = [](char c) {
            return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '-';
        };
        const bool is_word = std::ranges::any_of(name, is_letter) && std::ranges::all_of(name, [&](char c) {
                                 return is_letter(c) || (c >= '0' && c <= '9');
                             });
        return is_word ? fmt::format("{}.{}", kind, name) : fmt::format("{}.{}", kind, index);
    }

    void write_tracks(const std::string& owner, const std::vector<Track>& tracks) {
        for (const Track& track : tracks) {
            const bool is_place = track.name == "position" || track.name == "look_at";
            std::string keys = "[";
            for (std::size_t i = 0; i < track.keys.size(); ++i) {
                const auto& [time, value] = track.keys[i];
                const std::string number = fmt::format("{:.10g}", time + 0.0);
                constexpr std::size_t k_per_line = 2;
                keys += i == 0 ? "" : i % k_per_line == 0 ? ",\n    " : ", ";
                keys += fmt::format("[{}{}, {}]", number,
                                    number.find_first_of(".e") == std::string::npos ? ".0" : "",
                                    is_place ? vector_text(value, setting_.tolerance) : vector_text(value));
            }
            begin("[[animation.track]]");
            add("path", candela::toml_text(owner + "." + track.name));
            if (track.steps) add("interpolation", "\"step\"");
            add("keys", keys + "]");
            end();
        }
    }

    void write(const Light& light) {
        begin("[[light]]");
        light_names_.push_back(add_name(candela::printable(light.name)));
        add("type", candela::toml_text(light.type));
        if (light.type != "studio") add("color", color(light.color));
        add("intensity", light.is_physical ? fmt::format("\"{:.6g} {}\"", std::numbers::pi * light.intensity,
                                                         light.has_position() ? "cd" : "lx")
                                           : real(light.intensity));
        if (light.type == "studio") add("rotation", real(light.rotation));
        if (light.has_position()) add("position", vector_text(light.position, setting_.tolerance));
        if (light.type == "directional" || light.type == "spot")
            add("direction", vector_text(direction(light.direction)));
        if (light.type == "spot") {
            add("inner_angle", real(light.inner_angle));
            add("outer_angle", real(light.outer_angle));
        }
        end();
    }

    void write(const Part& part) {
        const Material* const material = part.material ? &model_.materials[*part.material] : nullptr;
        const bool is_textured = material != nullptr && material->color_map && setting_.is_textured;
        begin("[[object]]");
        object_names_.push_back(
            add_name(candela::printable(material != nullptr && !material->name.empty() ? material->name
                                        : part.selector.empty()                        ? "model"
                                                                                       : part.selector)));
        add("type", "\"mesh\"");
        add("file", candela::toml_text(setting_.file));
        if (!part.selector.empty()) add("part", candela::toml_text(part.selector));
        add("appearance_imported", "true");
        if (!setting_.origin.empty()) add("origin", candela::toml_text(setting_.origin));
        if (setting_.allows_outside) add("allow_outside", "true");
        if (part.is_flat) add("crease_angle", "0.0");
        if (part.sides != Sides::outside) add("sides", part.sides == Sides::front ? "\"front\"" : "\"both\"");
        if (model_.is_z_up) add("rotation", "[-90.0, 0.0, 0.0]");
        // Intentionally visible from both sides.
        if (model_.parts.size() > 1 || !setting_.is_closed || !model_.lights.empty() ||
            part.sides == Sides::both || setting_.frames > 0)
            add("encloses", "true");
        if (is_textured) {
            add("color", text_of(*material->color_map));
        } else if (material != nullptr) {
            add("color", color(material->color));
        } else {
            add("color", setting_.has_vertex_colors ? "[255, 255, 255]" : "[200, 200, 200]");
        }
        if (material != nullptr && material->normals && setting_.is_textured)
            add(material->has_heights ? "bump_map" : "normal_map",
                text_of(*material->normals, material->has_heights));
        if (material != nullptr && material->reflection != reflection_)
            add("reflection", candela::toml_text(material->reflection));
        if (material == nullptr && reflection_ != "phong") add("reflection", "\"phong\"");
        end();
        begin_material();
        if (material == nullptr) {
            add("ka", "0.3");
            add("kd", "0.75");
            add("ks", "0.2");
            add("shininess", "40.0");
        } else {
            for (const auto& [name, value] : material->values) {
                std::vector<std::string> factors;
                for (const ParameterMap& map : material->maps)
                    if (map.parameter == name && (setting_.is_textured || !map.attribute.empty()))
                        factors.push_back(text_of(map));
                add(name, factors.empty()       ? numbers_text(value)
                          : factors.size() == 1 ? factors.front()
                                                : fmt::format("[{}]", fmt::join(factors, ", ")));
            }
            add_emission(*material);
        }
        end();
    }
    void add_emission(const Material& material) {
        const auto map = std::ranges::find(material.maps, "emission", &ParameterMap::parameter);
        const bool is_textured = map != material.maps.end() && setting_.is_textured;
        if (!is_textured && material.emission == Vector{0, 0, 0}) return;
        add("emission", is_textured ? text_of(*map) : color(material.emission));
        if (material.emission_strength != 1) add("emission_strength", real(material.emission_strength));
    }
    static std::string numbers_text(const std::vector<double>& v) {
        return v.size() == 3 ? vector_text({v[0], v[1], v[2]}) : real(v[0]);
    }
    static std::string pair_text(const std::array<double, 2>& v) {
        return fmt::format("[{}, {}]", real(v[0]), real(v[1]));
    }

    /// An inline table with what differs from the defaults.
    std::string text_of(const ParameterMap& map, bool has_heights = false) const {
        std::string text =
            map.attribute.empty()
                ? fmt::format("{{ texture = {}", candela::toml_text(setting_.images[map.image]))
                : fmt::format("{{ attribute = {}", candela::toml_text(map.attribute));
        const auto add_entry = [&](const char* key, const std::string& value) {
            text += fmt::format(", {} = {}", key, value);
        };
        if (!map.channel.empty()) add_entry("channel", candela::toml_text(map.channel));
        if (has_heights) {
            add_entry("height", fmt::format("{:.4g}", map.scale[0]));
        } else if (map.scale != std::vector<double>{1}) {
            add_entry("scale", numbers_text(map.scale));
        }
        if (map.offset != std::vector<double>{0}) add_entry("offset", numbers_text(map.offset));
        const Placing& placing = map.placing;
        if (placing.wrap != "repeat") add_entry("wrap", candela::toml_text(placing.wrap));
        if (placing.wrap_v != placing.wrap) add_entry("wrap_v", candela::toml_text(placing.wrap_v));
        if (placing.uv != 0) add_entry("uv", fmt::format("{}", placing.uv));
        if (placing.is_transformed())
            add_entry("transform", fmt::format("{{ scale = {}, rotation = {}, offset = {} }}",
                                               pair_text(map.placing.scale), real(map.placing.rotation),
                                               pair_text(map.placing.offset)));
        return text + " }";
    }

    void begin_material() { text_ += "[object.material]\n"; }

    const Model& model_;
    const Setting& setting_;
    std::string text_;
    std::vector<std::pair<std::string, std::string>> entries_;
    std::string reflection_;
    std::set<std::string> names_;
    std::vector<std::string> light_names_, object_names_;
};

}  // namespace

std::string vector_text(const Vector& v, double tolerance) {
    return fmt::format("[{}, {}, {}]", real(v[0], tolerance), real(v[1], tolerance), real(v[2], tolerance));
}

std::string scene_text(const Model& model, const Setting& setting) { return Writer(model, setting).write(); }

}  // namespace importing
