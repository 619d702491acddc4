#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>
#include <string>
#include <string_view>

#include "import/gltf_container.h"
#include "import/gltf_json.h"
#include "import/readers.h"
#include "import/vectors.h"

import candela.color;
import candela.diagnostics;
import candela.files;
import candela.formats;
import candela.text;

namespace fs = std::filesystem;

namespace importing {

namespace {

using gltf::array_of;
using gltf::element;
using gltf::index_of;
using gltf::Json;
using gltf::number;
using gltf::numbers;
using gltf::object_of;
using gltf::text;

/// A linear colour as a scene has it.
Vector encoded(const std::vector<double>& linear) {
    Vector color{};
    for (std::size_t k = 0; k < 3; ++k)
        color[k] =
            std::round(255 * candela::linear_to_srgb(static_cast<float>(std::clamp(linear[k], 0.0, 1.0))));
    return color;
}

/// Columns of a node's transformation to the world.
struct Placement {
    Vector x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, origin{};

    Vector direction(Vector v) const { return v[0] * x + v[1] * y + v[2] * z; }
};

Placement placement_of(const Json& node) {
    Placement p;
    if (const std::vector<double> m = numbers(node, "matrix", 16); !m.empty()) {
        p.x = {m[0], m[1], m[2]};
        p.y = {m[4], m[5], m[6]};
        p.z = {m[8], m[9], m[10]};
        p.origin = {m[12], m[13], m[14]};
        return p;
    }
    if (const std::vector<double> q = numbers(node, "rotation", 4); !q.empty()) {
        const double x = q[0], y = q[1], z = q[2], w = q[3];
        p.x = {1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)};
        p.y = {2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)};
        p.z = {2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)};
    }
    if (const std::vector<double> s = numbers(node, "scale", 3); !s.empty()) {
        p.x = s[0] * p.x;
        p.y = s[1] * p.y;
        p.z = s[2] * p.z;
    }
    if (const std::vector<double> t = numbers(node, "translation", 3); !t.empty())
        p.origin = {t[0], t[1], t[2]};
    return p;
}

Placement within(const Placement& a, const Placement& b) {
    return {a.direction(b.x), a.direction(b.y), a.direction(b.z), a.origin + a.direction(b.origin)};
}

class Reader {
  public:
    Reader(const Source& source, candela::Registry& registry)
        : registry_(registry), container_(source), json_(container_.json()) {}

    Model read() {
        walk();
        add_parts();
        note_extensions();
        return std::move(model_);
    }

  private:
    // ---- nodes

    void walk() {
        const Json& nodes = array_of(json_, "nodes");
        std::vector<std::pair<std::size_t, Placement>> open;
        const auto add = [&](const Json& list, const Placement& parent) {
            for (auto it = list.rbegin(); it != list.rend(); ++it)
                if (it->is_number_unsigned()) open.emplace_back(it->get<std::size_t>(), parent);
        };
        const Json& scenes = array_of(json_, "scenes");
        if (!scenes.empty()) {
            if (const Json* const scene = element(scenes, index_of(json_, "scene").value_or(0)))
                add(array_of(*scene, "nodes"), {});
        } else if (!nodes.empty()) {
            std::set<std::size_t> children;
            for (const Json& node : nodes)
                for (const Json& child : array_of(node, "children"))
                    if (child.is_number_unsigned()) children.insert(child.get<std::size_t>());
            for (std::size_t i = nodes.size(); i-- > 0;)
                if (!children.contains(i)) open.emplace_back(i, Placement{});
        } else {
            for (const Json& mesh : array_of(json_, "meshes")) add_mesh(mesh);
        }
        std::vector<bool> seen(nodes.size());  // the shape `mesh` refuses nodes in two places
        while (!open.empty()) {
            const auto [index, parent] = open.back();
            open.pop_back();
            if (index >= nodes.size() || seen[index]) continue;
            seen[index] = true;
            const Json& node = nodes[index];
            const Placement place = within(parent, placement_of(node));
            if (const Json* const mesh = element(array_of(json_, "meshes"), index_of(node, "mesh")))
                add_mesh(*mesh);
            if (const Json* const camera = element(array_of(json_, "cameras"), index_of(node, "camera")))
                add_camera(*camera, place);
            const Json& used = object_of(object_of(node, "extensions"), "KHR_lights_punctual");
            const Json& all = object_of(object_of(json_, "extensions"), "KHR_lights_punctual");
            if (const Json* const light = element(array_of(all, "lights"), index_of(used, "light")))
                add_light(*light, text(node, "name"), place);
            add(array_of(node, "children"), place);
        }
    }

    void add_mesh(const Json& mesh) {
        for (const Json& primitive : array_of(mesh, "primitives")) {
            const std::size_t mode = index_of(primitive, "mode").value_or(4);
            if (mode < 4 || !object_of(primitive, "attributes").contains("POSITION")) continue;
            const auto index = index_of(primitive, "material");
            const bool is_known = element(array_of(json_, "materials"), index) != nullptr;
            const std::optional<std::size_t> material = is_known ? index : std::nullopt;
            if (known_materials_.insert(material).second) used_materials_.push_back(material);
        }
    }

    void add_camera(const Json& camera, const Placement& place) {
        if (model_.camera) return model_.note("cameras other than the first are left out");
        Camera result{.position = place.origin, .towards = unit(-1 * place.z), .up = unit(place.y)};
        if (text(camera, "type") == "orthographic") {
            const Json& values = object_of(camera, "orthographic");
            const double x = std::abs(number(values, "xmag", 1)), y = std::abs(number(values, "ymag", 1));
            result.is_orthographic = true;
            result.extent = 2 * y;
            result.aspect = y > 0 ? x / y : 0;
        } else {
            const Json& values = object_of(camera, "perspective");
            result.extent = number(values, "yfov", 0.7) * 180 / std::numbers::pi;
            result.aspect = number(values, "aspectRatio", 0);
        }
        const bool shows_some = result.is_orthographic ? result.extent > 1e-9 && result.extent < 1e9
                                                       : result.extent > 1e-3 && result.extent < 179;
        const bool is_sound =
            length(result.towards) > 0 && length(cross(result.towards, result.up)) > 1e-6 && shows_some;
        if (!is_sound) return model_.note("a camera that shows nothing is left out");
        model_.camera = result;
    }

    void add_light(const Json& light, const std::string& node_name, const Placement& place) {
        Light result{.name = text(light, "name"), .type = text(light, "type")};
        if (result.name.empty()) result.name = node_name;
        if (result.type != "point" && result.type != "spot" && result.type != "directional")
            return model_.note("lights of other types than point, spot and directional are left out");
        if (const std::vector<double> color = numbers(light, "color", 3); !color.empty())
            result.color = encoded(color);
        // Candela's models have no 1 / pi in what they reflect.
        constexpr double k_brightest = 1e30;  // so that sums of some are numbers
        result.intensity = std::clamp(number(light, "intensity", 1), 0.0, k_brightest) * std::numbers::inv_pi;
        result.position = place.origin;
        result.direction = unit(-1 * place.z);
        if (length(result.direction) == 0) return model_.note("a light without a direction is left out");
        if (light.is_object() && light.contains("range"))
            model_.note("the ranges of lights are left out: they shine as far as light does");
        if (result.type == "spot") {
            const Json& spot = object_of(light, "spot");
            constexpr double k_degrees = 180 / std::numbers::pi;
            result.outer_angle =
                std::clamp(number(spot, "outerConeAngle", std::numbers::pi / 4) * k_degrees, 0.1, 89.0);
            result.inner_angle =
                std::clamp(number(spot, "innerConeAngle", 0) * k_degrees, 0.0, result.outer_angle);
            model_.note(
                "between a spotlight's cones light falls off as a smoothstep of the cosine, not as its "
                "square");
        }
        model_.lights.push_back(result);
    }

    // ---- materials

    void add_parts() {
        std::map<std::string, int> names;
        for (const Json& material : array_of(json_, "materials")) ++names[text(material, "name")];
        for (const std::optional<std::size_t> index : used_materials_) {
            Part part;
            std::string name;
            if (index) name = text(array_of(json_, "materials")[*index], "name");
            if (used_materials_.size() > 1) {
                const bool is_unique =
                    !name.empty() && names[name] == 1 && !name.starts_with('#') && name != "(none)";
                part.selector = !index ? "(none)" : is_unique ? name : fmt::format("#{}", *index);
            }
            if (index) {
                part.material = model_.materials.size();
                model_.materials.push_back(material(array_of(json_, "materials")[*index], name));
            }
            model_.parts.push_back(part);
        }
        if (model_.parts.empty()) model_.parts.emplace_back();
    }

    /// glTF 2.0, appendix B: a dielectric's diffuse and specular light, blended with a metal's.
    Material material(const Json& from, const std::string& name) {
        const Json& pbr = object_of(from, "pbrMetallicRoughness");
        std::vector<double> base = numbers(pbr, "baseColorFactor", 4);
        if (base.empty()) base = {1, 1, 1, 1};
        const double metallic = std::clamp(number(pbr, "metallicFactor", 1), 0.0, 1.0);
        const double roughness = std::clamp(number(pbr, "roughnessFactor", 1), 0.0, 1.0);
        const double ior = number(object_of(object_of(from, "extensions"), "KHR_materials_ior"), "ior", 1.5);
        const std::vector<double> dielectric = dielectric_of(from, std::pow((ior - 1) / (ior + 1), 2));
        Material result{.name = name, .reflection = "ggx", .color = encoded(base)};
        if (const Json* const found = gltf::find(pbr, "baseColorTexture")) texture(*found, name, result);
        if (object_of(pbr, "metallicRoughnessTexture").contains("index")) {
            model_.note(
                "textures of metalness and roughness are left out; the factors hold for the whole surface");
        }
        std::vector<double> specular(3);
        for (std::size_t k = 0; k < 3; ++k) {
            const double metal = result.picture ? 1 : std::clamp(base[k], 0.0, 1.0);
            specular[k] = std::round(1e4 * (dielectric[k] * (1 - metallic) + metal * metallic)) / 1e4;
        }
        const bool is_grey = specular[0] == specular[1] && specular[1] == specular[2];
        const double diffuse = (1 - metallic) * (1 - *std::ranges::max_element(dielectric));
        if (result.picture && metallic > 0)
            model_.note("the highlights of textured metals have no colour of the texture's");
        model_.note(
            "metallic-roughness materials are 'ggx' with highlights of the reflectance at normal "
            "incidence, which does not rise towards grazing angles");
        result.values = {{"ka", {std::round(1e4 * (diffuse + 0.5 * metallic)) / 1e4}},
                         {"kd", {std::round(1e4 * diffuse) / 1e4}},
                         {"ks", is_grey ? std::vector{specular[0]} : specular},
                         {"roughness", {std::max(std::round(1e4 * roughness * roughness) / 1e4, 0.02)}},
                         {"ior", {100}}};
        if (from.is_object()) note_losses(from, base[3]);
        return result;
    }

    /// What the dielectric mirrors at normal incidence: KHR_materials_specular.
    static std::vector<double> dielectric_of(const Json& from, double usual) {
        const Json& specular = object_of(object_of(from, "extensions"), "KHR_materials_specular");
        std::vector<double> color = numbers(specular, "specularColorFactor", 3);
        if (color.empty()) color = {1, 1, 1};
        const double factor = std::clamp(number(specular, "specularFactor", 1), 0.0, 1.0);
        for (double& channel : color) channel = factor * std::clamp(usual * channel, 0.0, 1.0);
        return color;
    }

    void note_losses(const Json& from, double opacity) {
        const std::string mode = text(from, "alphaMode");
        if (mode == "BLEND" || mode == "MASK" || opacity < 1)
            model_.note("the opacity of materials is left out: they are opaque");
        if (from.contains("normalTexture")) model_.note("normal maps are left out");
        if (from.contains("occlusionTexture")) model_.note("occlusion maps are left out");
        const std::vector<double> emission = numbers(from, "emissiveFactor", 3);
        if (std::ranges::any_of(emission, [](double x) { return x > 0; }))
            model_.note("the light that materials emit is left out");
        const Json& extensions = object_of(from, "extensions");
        for (const auto& [name, unused] : extensions.items())
            if (name != "KHR_materials_ior" && name != "KHR_materials_specular") left_out_.insert(name);
        for (const char* const map : {"specularTexture", "specularColorTexture"})
            if (object_of(extensions, "KHR_materials_specular").contains(map))
                model_.note(
                    "textures of what a surface mirrors are left out; the factors hold for the whole "
                    "surface");
    }

    void texture(const Json& info, const std::string& material, Material& to) {
        if (index_of(info, "texCoord").value_or(0) != 0)
            return model_.note("textures that use further texture coordinates are left out");
        if (object_of(info, "extensions").contains("KHR_texture_transform"))
            left_out_.insert("KHR_texture_transform");
        const Json* const texture = element(array_of(json_, "textures"), index_of(info, "index"));
        if (texture == nullptr)
            return model_.note(fmt::format("there is no texture that material '{}' names", material));
        if (const Json* const sampler = element(array_of(json_, "samplers"), index_of(*texture, "sampler"))) {
            const std::size_t s = index_of(*sampler, "wrapS").value_or(10497),
                              t = index_of(*sampler, "wrapT").value_or(10497);
            to.clamps = s == 33071 && t == 33071;
            if (s == 33648 || t == 33648) model_.note("mirrored repetition of textures is plain repetition");
            if (s != t) model_.note("textures that repeat in one direction only repeat in both");
        }
        auto source = index_of(*texture, "source");
        for (const char* const extension : {"EXT_texture_webp", "KHR_texture_basisu"})
            if (!source) source = index_of(object_of(object_of(*texture, "extensions"), extension), "source");
        if (!source || element(array_of(json_, "images"), source) == nullptr)
            return model_.note(fmt::format("there is no picture for the texture of material '{}'", material));
        const auto known = pictures_.find(*source);
        to.picture =
            known != pictures_.end() ? known->second : pictures_[*source] = picture(*source, material);
    }

    std::optional<std::size_t> picture(std::size_t index, const std::string& material) {
        try {
            Picture found = container_.picture(index);
            if (!is_readable_picture(found.file, registry_)) {
                model_.note(
                    fmt::format("the texture of material '{}' is of a format that no image plugin reads{}",
                                material, candela::possible_formats(registry_, candela::FormatUse::read)));
                return std::nullopt;
            }
            model_.pictures.push_back(std::move(found));
            return model_.pictures.size() - 1;
        } catch (const candela::Error& problem) {
            model_.note(
                fmt::format("the texture of material '{}' is left out: {}", material, problem.what()));
            return std::nullopt;
        }
    }

    void note_extensions() {
        for (const std::string& name : left_out_)
            model_.note(fmt::format("the extension '{}' is left out", name));
    }

    candela::Registry& registry_;
    gltf::Container container_;
    const Json& json_;
    Model model_;
    std::vector<std::optional<std::size_t>> used_materials_;  // by the order of their first triangles
    std::set<std::optional<std::size_t>> known_materials_;
    std::map<std::size_t, std::optional<std::size_t>> pictures_;  // by image
    std::set<std::string> left_out_;
};

}  // namespace

Model read_gltf(const Source& source, candela::Registry& registry) { return Reader(source, registry).read(); }

}  // namespace importing
