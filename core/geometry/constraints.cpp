module;

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

module candela.geometry;

import candela.api;
import candela.plugins;
import candela.scene;
import candela.util;

namespace candela {

namespace {

/// Tolerance for rounding: an object on the floor may be slightly below it.
constexpr float k_hair = 1e-5f;  // of the room's size

/// More would only repeat the first thousand, and there might be billions.
constexpr std::size_t k_most_overlaps = 1000;

/// Few enough to give up a scene with too many overlaps before all its bodies have been made.
constexpr std::size_t k_bodies_at_once = 64;

constexpr std::array<char, 3> k_axis_names = {'x', 'y', 'z'};

std::array<float, 3> components(Vec3 v) { return {v.x, v.y, v.z}; }

std::string at(const SourceLocation& place) {
    return place.line > 0 ? fmt::format(" (at {}:{}:{})", place.file, place.line, place.column)
                          : std::string();
}

class Checker {
  public:
    Checker(const SceneDraft& draft, std::span<const SurfaceView> surfaces, Diagnostics& diagnostics)
        : draft_(draft),
          scene_(draft.scene),
          surfaces_(surfaces),
          diagnostics_(diagnostics),
          boxes_(boxes_of(surfaces)),
          tree_(boxes_),
          bodies_(surfaces.size()) {}

    void run(const std::function<void()>& checked) {
        if (draft_.has_room) check_room();
        check_lights();
        if (draft_.has_observer) {
            report_if_inside("the observer", scene_.observer.position, scene_.observer.position_place);
        }
        check_overlaps(checked);
    }

  private:
    static std::vector<Box> boxes_of(std::span<const SurfaceView> surfaces) {
        std::vector<Box> boxes;
        for (const SurfaceView& surface : surfaces)
            boxes.push_back(surface.empty() ? Box{} : box_around(surface.position, surface.vertex_count));
        return boxes;
    }

    void check_room() {
        const Room& room = scene_.room;
        const Vec3 half{room.width / 2, room.height / 2, room.depth / 2};
        if (draft_.has_observer) {
            report_if_outside("the observer", {scene_.observer.position, scene_.observer.position}, half,
                              scene_.observer.position_place);
        }
        for (const LightSource& light : scene_.lights) {
            if (const auto p = position_of(light)) {
                report_if_outside("light " + light.label.text(), {*p, *p}, half, light.position_place);
            }
        }
        for (std::size_t i = 0; i < scene_.objects.size(); ++i) {
            const Object& object = scene_.objects[i];
            if (!surfaces_[i].empty())
                report_if_outside("object " + object.label.text(), boxes_[i], half, object.position_place);
        }
    }

    /// One message, for the axis along which it is farthest outside.
    void report_if_outside(const std::string& what, const Box& box, Vec3 half, const SourceLocation& place) {
        const auto low = components(box.low), high = components(box.high), room = components(half);
        std::size_t worst = 0;
        float distance = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const float beyond = std::max(high[k] - room[k], -room[k] - low[k]);
            if (beyond <= k_hair * room[k] || beyond <= distance) continue;
            worst = k;
            distance = beyond;
        }
        if (distance == 0) return;
        const bool is_point = box.low == box.high;
        const std::string where = is_point ? fmt::format("its {} is {:.6g}", k_axis_names[worst], low[worst])
                                           : fmt::format("it reaches from {0} = {1:.6g} to {0} = {2:.6g}",
                                                         k_axis_names[worst], low[worst], high[worst]);
        diagnostics_.error(
            place, fmt::format("{} is not {}inside the room: {}", what, is_point ? "" : "wholly ", where),
            fmt::format("the room reaches from {0} = {1:.6g} to {0} = {2:.6g}", k_axis_names[worst],
                        -room[worst], room[worst]));
    }

    void check_lights() {
        std::map<std::array<float, 3>, const LightSource*> taken;
        for (const LightSource& light : scene_.lights) {
            const auto p = position_of(light);
            if (!p) continue;
            const std::string what = "light " + light.label.text();
            const auto [first, is_new] = taken.try_emplace(components(*p + Vec3{}), &light);
            if (!is_new) {
                diagnostics_.error(
                    light.position_place,
                    fmt::format("{} is at the same place as light {}{}", what, first->second->label.text(),
                                at(first->second->position_place)),
                    "move one of them, or replace both by one light with the sum of their intensities");
            }
            if (draft_.has_observer && *p == scene_.observer.position) {
                diagnostics_.error(light.position_place, fmt::format("{} is where the observer is{}", what,
                                                                     at(scene_.observer.position_place)));
            }
            report_if_inside(what, *p, light.position_place);
        }
    }

    void report_if_inside(const std::string& what, Vec3 point, const SourceLocation& place) {
        for (const std::size_t i : tree_.at(point)) {
            if (surfaces_[i].empty() || is_hollow(i) || !body(i).contains(point)) continue;
            diagnostics_.error(
                place,
                fmt::format("{} is inside object {}{}", what, scene_.objects[i].label.text(),
                            at(scene_.objects[i].place)),
                "move one of them; if the object is a room or a shade, add to it: encloses = true");
        }
    }

    /// For those objects, from `first` on, whose boxes overlap others, on several threads.
    void make_bodies(std::size_t first) {
        const std::size_t count = std::min(k_bodies_at_once, surfaces_.size() - first);
        parallel_for(count, 1, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = first + begin; i < first + end; ++i)
                if (!surfaces_[i].empty() && !tree_.meeting(i).empty()) body(i);
        });
    }

    void check_overlaps(const std::function<void()>& checked) {
        const bool checks_overlaps = scene_.constraints.overlap != Overlap::allow;
        std::size_t found = 0;
        for (std::size_t i = 0; i < surfaces_.size(); ++i) {
            if (checks_overlaps && i % k_bodies_at_once == 0) make_bodies(i);
            if (checked) checked();
            if (surfaces_[i].empty() || !checks_overlaps) continue;
            for (const std::size_t j : tree_.meeting(i)) {
                if (j >= i || surfaces_[j].empty() || !overlap(body(i), body(j))) continue;
                const Object& first = scene_.objects[j];
                const Object& second = scene_.objects[i];
                report_overlap(second.position_place,
                               fmt::format("object {} overlaps object {}{}", second.label.text(),
                                           first.label.text(), at(first.position_place)));
                if (++found == k_most_overlaps) {
                    report_overlap(second.position_place,
                                   fmt::format("{} objects overlap; the rest is not checked", found));
                    return;
                }
            }
        }
    }

    void report_overlap(const SourceLocation& place, std::string message) {
        if (scene_.constraints.overlap == Overlap::warn) {
            diagnostics_.warning(place, std::move(message));
        } else {
            diagnostics_.error(
                place, std::move(message),
                "move one of them; if one is a room or a shade for the other, add to it: encloses = true");
        }
    }

    /// An open surface has no inside, and one that encloses others is meant to have them there.
    bool is_hollow(std::size_t i) const { return !surfaces_[i].closed || scene_.objects[i].encloses; }

    /// Created on demand: most objects are far from everything else. Different ones on different threads.
    const Body& body(std::size_t i) {
        if (!bodies_[i]) {
            const SurfaceView& surface = surfaces_[i];
            bodies_[i].emplace(surface.position, surface.vertex_count, surface.indices, surface.closed,
                               is_hollow(i) ? Solidity::hollow : Solidity::solid);
        }
        return *bodies_[i];
    }

    const SceneDraft& draft_;
    const Scene& scene_;
    std::span<const SurfaceView> surfaces_;
    Diagnostics& diagnostics_;
    std::vector<Box> boxes_;
    BoxTree tree_;
    std::vector<std::optional<Body>> bodies_;
};

}  // namespace

std::optional<Vec3> position_of(const LightSource& light) {
    const ParamSet& parameters = light.model.parameters;
    const std::size_t index = parameters.index_of("position");
    if (index == parameters.schema().size() || parameters.schema()[index].type != ParamType::point)
        return std::nullopt;
    const auto& value = parameters.get(index);
    return value ? std::optional(std::get<Vec3>(*value)) : std::nullopt;
}

void check_constraints(const SceneDraft& draft, std::span<const SurfaceView> surfaces,
                       Diagnostics& diagnostics, const std::function<void()>& checked) {
    Checker(draft, surfaces, diagnostics).run(checked);
}

}  // namespace candela
