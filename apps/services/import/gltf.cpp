#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "import/gltf_animation.h"
#include "import/gltf_container.h"
#include "import/gltf_materials.h"
#include "import/placement.h"
#include "import/readers.h"
#include "import/vectors.h"

import candela.api;
import candela.plugins;
import candela.util;

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
using gltf::placement_of;
using gltf::text_of;

class Reader {
  public:
    Reader(const Source& source, bool with_animation, candela::Registry& registry)
        : container_(source),
          json_(container_.json()),
          with_animation_(with_animation),
          materials_(container_, registry, model_) {}

    Model read() {
        const Json& animations = array_of(json_, "animations");
        for (const Json& animation : animations) model_.moving.names.push_back(text_of(animation, "name"));
        if (with_animation_ && !animations.empty())
            animation_ = std::make_shared<gltf::Animation>(container_, animations[0]);
        walk();
        add_parts();
        if (animation_ != nullptr) {
            model_.moving.length = animation_->length();
            model_.moving.has_splines = animation_->has_splines();
            model_.moving.weights = animation_->weights();
            model_.moving.channels = animation_->unreadable();
        }
        return std::move(model_);
    }

  private:
    // ---- nodes

    void walk() {
        const Json& nodes = array_of(json_, "nodes");
        struct Open {
            std::size_t node;
            Placement parent;
            std::optional<std::size_t> above{},
                mover{};  // its parent; the node that moves that: it or an ancestor
        };
        std::vector<Open> open;
        const auto add = [&](const Json& list, const Open& parent) {
            for (auto it = list.rbegin(); it != list.rend(); ++it) {
                if (!it->is_number_unsigned()) continue;
                open.push_back(parent);
                open.back().node = it->get<std::size_t>();
            }
        };
        const Json& scenes = array_of(json_, "scenes");
        if (!scenes.empty()) {
            if (const Json* const scene = element(scenes, index_of(json_, "scene").value_or(0)))
                add(array_of(*scene, "nodes"), {.node = 0, .parent = {}});
        } else if (!nodes.empty()) {
            std::set<std::size_t> children;
            for (const Json& node : nodes)
                for (const Json& child : array_of(node, "children"))
                    if (child.is_number_unsigned()) children.insert(child.get<std::size_t>());
            for (std::size_t i = nodes.size(); i-- > 0;)
                if (!children.contains(i)) open.push_back({.node = i, .parent = {}});
        } else {
            for (const Json& mesh : array_of(json_, "meshes")) add_mesh(mesh, std::nullopt);
        }
        std::vector<bool> seen(nodes.size());  // the shape `mesh` rejects nodes with two parents
        while (!open.empty()) {
            const auto [index, parent, above, above_mover] = open.back();
            open.pop_back();
            if (index >= nodes.size() || seen[index]) continue;
            seen[index] = true;
            const Json& node = nodes[index];
            const Json& visibility = object_of(object_of(node, "extensions"), "KHR_node_visibility");
            if (const Json* const visible = gltf::find(visibility, "visible");
                visible != nullptr && *visible == false)
                continue;
            const Placement place = within(parent, placement_of(node));
            above_[index] = above;
            const bool moves = animation_ != nullptr && animation_->moves(index);
            const std::optional<std::size_t> mover = moves ? index : above_mover;
            if (const Json* const mesh = element(array_of(json_, "meshes"), index_of(node, "mesh")))
                add_mesh(*mesh, mover_of_mesh(node, mover));
            if (const Json* const camera = element(array_of(json_, "cameras"), index_of(node, "camera")))
                add_camera(*camera, place, motion_of(mover, index, false));
            const Json& used = object_of(object_of(node, "extensions"), "KHR_lights_punctual");
            const Json& all = object_of(object_of(json_, "extensions"), "KHR_lights_punctual");
            if (const Json* const light = element(array_of(all, "lights"), index_of(used, "light")))
                add_light(*light, text_of(node, "name"), place, motion_of(mover, index, false));
            add(array_of(node, "children"), {.node = 0, .parent = place, .above = index, .mover = mover});
        }
    }

    /// The node that moves a node's mesh as a whole; nothing for a node with a skin.
    std::optional<std::size_t> mover_of_mesh(const Json& node, std::optional<std::size_t> mover) {
        const Json* const skin = element(array_of(json_, "skins"), index_of(node, "skin"));
        if (skin == nullptr) return mover;
        const bool moves = std::ranges::any_of(array_of(*skin, "joints"), [&](const Json& joint) {
            return joint.is_number_unsigned() && animation_ != nullptr &&
                   animation_->moves(joint.get<std::size_t>());
        });
        if (moves) ++model_.moving.skins;
        return std::nullopt;
    }

    /// The motion of `node`, caused by `mover`. Relative: for parts whose coordinates include the rest
    /// position.
    std::shared_ptr<const Motion> motion_of(std::optional<std::size_t> mover, std::size_t node,
                                            bool is_relative) {
        if (!mover) return nullptr;
        std::vector<std::size_t> chain;
        for (std::optional<std::size_t> at = node; at; at = above_.at(*at)) chain.push_back(*at);
        std::ranges::reverse(chain);
        auto motion = gltf::Animation::motion(animation_, array_of(json_, "nodes"), chain, is_relative);
        if (motion == nullptr) ++model_.moving.undone;
        return motion;
    }

    void add_mesh(const Json& mesh, std::optional<std::size_t> mover) {
        for (const Json& primitive : array_of(mesh, "primitives")) {
            const std::size_t mode = index_of(primitive, "mode").value_or(4);
            if (mode < 4 || !object_of(primitive, "attributes").contains("POSITION")) continue;
            const auto index = index_of(primitive, "material");
            const bool is_known = element(array_of(json_, "materials"), index) != nullptr;
            const std::optional<std::size_t> material = is_known ? index : std::nullopt;
            if (known_materials_.insert(material).second) used_materials_.push_back(material);
            movers_[material].insert(mover);
            // glTF 2.0, 3.7.2.1: without normals, triangles are flat.
            if (!object_of(primitive, "attributes").contains("NORMAL")) flat_materials_.insert(material);
        }
    }

    void add_camera(const Json& camera, const Placement& place, std::shared_ptr<const Motion> motion) {
        if (model_.camera) return model_.note("cameras other than the first are left out");
        Camera result{.position = place.origin, .towards = unit(-1 * place.z), .up = unit(place.y)};
        if (text_of(camera, "type") == "orthographic") {
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
        if (!is_sound) return model_.note("a camera with an empty view is left out");
        result.motion = std::move(motion);
        model_.camera = result;
    }

    void add_light(const Json& light, const std::string& node_name, const Placement& place,
                   std::shared_ptr<const Motion> motion) {
        Light result{.name = text_of(light, "name"), .type = text_of(light, "type")};
        if (result.name.empty()) result.name = node_name;
        if (result.type != "point" && result.type != "spot" && result.type != "directional")
            return model_.note("lights of other types than point, spot and directional are left out");
        if (const std::vector<double> color = numbers(light, "color", 3); !color.empty())
            result.color = encoded(color);
        // Candela's models have no factor of 1 / pi in what they reflect.
        constexpr double k_brightest = 1e30;  // so that sums of several stay finite
        result.intensity = std::clamp(number(light, "intensity", 1), 0.0, k_brightest) * std::numbers::inv_pi;
        result.is_physical = true;
        result.position = place.origin;
        result.direction = unit(-1 * place.z);
        if (length(result.direction) == 0) return model_.note("a light without a direction is left out");
        if (light.is_object() && light.contains("range"))
            model_.note("the ranges of lights are left out: their light has no limit");
        if (result.type == "spot") {
            const Json& spot = object_of(light, "spot");
            constexpr double k_degrees = 180 / std::numbers::pi;
            result.outer_angle =
                std::clamp(number(spot, "outerConeAngle", std::numbers::pi / 4) * k_degrees, 0.1, 89.0);
            result.inner_angle =
                std::clamp(number(spot, "innerConeAngle", 0) * k_degrees, 0.0, result.outer_angle);
            model_.note(
                "between a spotlight's cones, the light falls off as a smoothstep of the cosine, not as its "
                "square");
        }
        result.motion = std::move(motion);
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
        for (const Json& material : array_of(json_, "materials")) ++names[text_of(material, "name")];
        for (const std::optional<std::size_t> index : used_materials_) {
            Part part;
            part.is_flat = flat_materials_.contains(index);
            part.sides = is_double_sided(index) ? Sides::both : Sides::front;
            std::string name;
            if (index) name = text_of(array_of(json_, "materials")[*index], "name");
            if (used_materials_.size() > 1) {
                const bool is_unique =
                    !name.empty() && names[name] == 1 && !name.starts_with('#') && name != "(none)";
                part.selector = !index ? "(none)" : is_unique ? name : fmt::format("#{}", *index);
            }
            if (index) {
                part.material = model_.materials.size();
                model_.materials.push_back(materials_.material(*index));
            }
            const auto& movers = movers_[index];
            if (movers.size() > 1) {
                ++model_.moving.in_pieces;
            } else if (const auto mover = *movers.begin()) {
                part.motion = motion_of(mover, *mover, true);
            }
            model_.parts.push_back(part);
        }
        if (model_.parts.empty()) model_.parts.emplace_back();
    }

    gltf::Container container_;
    const Json& json_;
    bool with_animation_;
    std::shared_ptr<const gltf::Animation> animation_;         // null: nothing moves
    std::map<std::size_t, std::optional<std::size_t>> above_;  // nodes' parents
    Model model_;
    gltf::Materials materials_;
    std::vector<std::optional<std::size_t>> used_materials_;  // by the order of their first triangles
    std::set<std::optional<std::size_t>> known_materials_;
    std::map<std::optional<std::size_t>, std::set<std::optional<std::size_t>>> movers_;  // by material
    std::set<std::optional<std::size_t>> flat_materials_;  // of triangles without normals
};

}  // namespace

Model read_gltf(const Source& source, bool with_animation, candela::Registry& registry) {
    return Reader(source, with_animation, registry).read();
}

}  // namespace importing
