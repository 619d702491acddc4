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
#include "import/gltf_materials.h"
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
        : container_(source), json_(container_.json()), materials_(container_, registry, model_) {}

    Model read() {
        walk();
        add_parts();
        if (const std::size_t count = array_of(json_, "animations").size(); count > 0)
            model_.note(count == 1
                            ? "its animation is left out: it is shown at rest"
                            : fmt::format("its {} animations are left out: it is shown at rest", count));
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
            const Json& visibility = object_of(object_of(node, "extensions"), "KHR_node_visibility");
            if (const Json* const visible = gltf::find(visibility, "visible");
                visible != nullptr && *visible == false)
                continue;
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
            // glTF 2.0, 3.7.2.1: without normals, triangles are flat.
            if (!object_of(primitive, "attributes").contains("NORMAL")) flat_materials_.insert(material);
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
            result.color = gltf::encoded(color);
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

    bool is_double_sided(std::optional<std::size_t> material) const {
        const Json* const from = element(array_of(json_, "materials"), material);
        const Json* const both = from == nullptr ? nullptr : gltf::find(*from, "doubleSided");
        return both != nullptr && *both == true;
    }

    void add_parts() {
        std::map<std::string, int> names;
        for (const Json& material : array_of(json_, "materials")) ++names[text(material, "name")];
        for (const std::optional<std::size_t> index : used_materials_) {
            Part part;
            part.is_flat = flat_materials_.contains(index);
            part.sides = is_double_sided(index) ? Sides::both : Sides::front;
            std::string name;
            if (index) name = text(array_of(json_, "materials")[*index], "name");
            if (used_materials_.size() > 1) {
                const bool is_unique =
                    !name.empty() && names[name] == 1 && !name.starts_with('#') && name != "(none)";
                part.selector = !index ? "(none)" : is_unique ? name : fmt::format("#{}", *index);
            }
            if (index) {
                part.material = model_.materials.size();
                model_.materials.push_back(materials_.material(*index));
            }
            model_.parts.push_back(part);
        }
        if (model_.parts.empty()) model_.parts.emplace_back();
    }

    gltf::Container container_;
    const Json& json_;
    Model model_;
    gltf::Materials materials_;
    std::vector<std::optional<std::size_t>> used_materials_;  // by the order of their first triangles
    std::set<std::optional<std::size_t>> known_materials_;
    std::set<std::optional<std::size_t>> flat_materials_;  // those of triangles without normals
};

}  // namespace

Model read_gltf(const Source& source, candela::Registry& registry) { return Reader(source, registry).read(); }

}  // namespace importing
