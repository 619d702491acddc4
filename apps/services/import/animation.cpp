#include "import/animation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <filesystem>
#include <new>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "import/motion.h"
#include "import/placement.h"
#include "import/vectors.h"

import candela.api;
import candela.geometry;
import candela.plugins;
import candela.util;

namespace importing {

namespace {

constexpr double k_fps = 24;
constexpr int k_most_frames = 1'000'000;

int frames_of(double length) {
    return 1 + static_cast<int>(std::clamp(std::floor(length * k_fps + 1e-3), 0.0, k_most_frames - 1.0));
}

/// The box of a part in the mesh's own coordinates.
std::optional<Bounds> box_of(candela::ParamSet parameters, const Part& part, candela::Registry& registry) {
    parameters.set("part", part.selector);
    const auto shape = registry.create<candela::Shape>("mesh", parameters, candela::ColorEncoding::srgb);
    try {
        const candela::Mesh mesh = candela::place(*shape, {}, {}).mesh;
        if (mesh.vertex_count() == 0) return std::nullopt;
        Bounds box;
        box.low.fill(HUGE_VAL);
        box.high.fill(-HUGE_VAL);
        for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
            const candela::Vec3 p = mesh.position.span()[i];
            const Vector v{p.x, p.y, p.z};
            for (std::size_t k = 0; k < 3; ++k) {
                box.low[k] = std::min(box.low[k], v[k]);
                box.high[k] = std::max(box.high[k], v[k]);
            }
        }
        return box;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception&) {
        return std::nullopt;  // reported when the scene is read
    }
}

std::array<Vector, 8> corners_of(const Bounds& box) {
    std::array<Vector, 8> corners{};
    for (std::size_t i = 0; i < 8; ++i)
        for (std::size_t k = 0; k < 3; ++k) corners[i][k] = (i >> k & 1) != 0 ? box.high[k] : box.low[k];
    return corners;
}

bool is_within_angle(const Vector& a, const Vector& b, double degrees) {
    return dot(unit(a), unit(b)) >= std::cos(degrees * std::numbers::pi / 180);
}

std::optional<State> if_near(const State& state) {
    constexpr double k_farthest = 1e9;
    for (const Vector& v : state)
        for (const double x : v)
            if (!(std::abs(x) <= k_farthest)) return std::nullopt;
    return state;
}

std::string counted(std::size_t count, const char* one, const char* many) {
    return count == 1 ? fmt::format("1 {}", one) : fmt::format("{} {}", count, many);
}

std::string quoted(const std::vector<std::string>& names) {
    std::vector<std::string> result;
    constexpr std::size_t k_most_named = 5;
    for (std::size_t i = 0; i < std::min(names.size(), k_most_named); ++i)
        result.push_back(names[i].empty() ? fmt::format("number {}", i + 2)
                                          : fmt::format("'{}'", candela::shortened(names[i])));
    if (names.size() > k_most_named) result.push_back(fmt::format("{} more", names.size() - k_most_named));
    return fmt::format("{}", fmt::join(result, ", "));
}

}  // namespace

void Animator::contain(const Vector& point) {
    for (std::size_t k = 0; k < 3; ++k) {
        all_.low[k] = std::min(all_.low[k], point[k]);
        all_.high[k] = std::max(all_.high[k], point[k]);
    }
}

void Animator::contain_positions(const std::vector<Track>& tracks) {
    for (const Track& track : tracks)
        if (track.name == "position")
            for (const auto& [time, value] : track.keys) contain(value);
}

void Animator::take_parts(const Source& source, candela::Registry& registry) {
    if (std::ranges::none_of(model_.parts, [](const Part& part) { return part.motion != nullptr; })) return;
    candela::ParamSet parameters = registry.parameters(candela::PluginKind::shape, "mesh");
    parameters.set("file", std::filesystem::absolute(source.file).string());
    parameters.set("allow_outside", source.allows_outside);
    if (!geometry_.origin.empty()) parameters.set("origin", geometry_.origin);
    // While this exists, the file is read only once.
    const auto whole = registry.create<candela::Shape>("mesh", parameters, candela::ColorEncoding::srgb);
    for (Part& part : model_.parts) {
        if (part.motion == nullptr) continue;
        if (const std::optional<Bounds> box = box_of(parameters, part, registry)) take_part(part, *box);
    }
}

void Animator::count_left_out(const Motion& motion) {
    ++(budget_ < motion.cost ? model_.moving.too_many : model_.moving.undone);
}

void Animator::take_part(Part& part, const Bounds& box) {
    const bool is_z_up = model_.is_z_up;
    const Vector& moved = geometry_.moved;
    Placement turn, from_origin, to_origin;
    if (is_z_up) turn = {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}, {}};
    from_origin.origin = is_z_up ? Vector{moved[0], -moved[2], moved[1]} : moved;
    to_origin.origin = -1 * moved;
    const auto in_scene = [&](const Placement& place) {
        return within(within(to_origin, turn), within(place, from_origin));
    };
    const auto corners = corners_of(box);
    const double tolerance = 1e-3 * box.radius(), little = 1e-7 * (box.radius() + length(box.center()));
    Mover mover{.names = {"position", "rotation", "scale"}, .tolerance = {0.1 * tolerance, 0.01, 1e-5}};
    mover.rest = {Vector{}, is_z_up ? Vector{-90, 0, 0} : Vector{}, Vector{1, 1, 1}};
    mover.state = [&](const Placement& place, const State& before) {
        auto state = state_of(in_scene(place), before);
        if (state)
            for (double& x : (*state)[0])
                if (std::abs(x) < little) x = 0;
        return state;
    };
    mover.is_close = [&](const State& values, const Placement& place) {
        const Placement is = placement_of(values), should = in_scene(place);
        return std::ranges::all_of(corners, [&](const Vector& corner) {
            return length(is.point(corner) - should.point(corner)) <= tolerance;
        });
    };
    auto tracks = tracks_of(*part.motion, mover, budget_);
    if (!tracks) {
        count_left_out(*part.motion);
        return;
    }
    if (tracks->empty()) return;
    part.tracks = std::move(*tracks);
    ++objects_;
    constexpr int k_most_looks = 1000;
    const int looks = std::min(4 * frames_of(model_.moving.length), k_most_looks);
    for (int i = 0; i <= looks; ++i) {
        const Placement place = placement_of(state_at(part.tracks, mover, model_.moving.length * i / looks));
        for (const Vector& corner : corners) {
            corners_.push_back(place.point(corner));
            contain(corners_.back());
        }
    }
}

bool Animator::is_seen(const Camera& camera) const {
    const Vector ahead = unit(camera.towards), right = unit(cross(ahead, camera.up)),
                 up = cross(right, ahead);
    const double slope = std::tan(0.5 * camera.extent * std::numbers::pi / 180);
    return std::ranges::all_of(corners_, [&](const Vector& corner) {
        const Vector way = corner - camera.position;
        const double depth = dot(way, ahead);
        return depth > 0 && std::abs(dot(way, up)) <= slope * depth &&
               std::abs(dot(way, right)) <= slope * camera.aspect * depth;
    });
}

void Animator::take_view(Setting& setting) {
    const double close = 1e-3 * geometry_.bounds.radius(), fine = 0.1 * close;
    const auto take = [&](const Motion& motion, const Mover& mover, std::vector<Track>& to) {
        auto tracks = tracks_of(motion, mover, budget_);
        if (!tracks) {
            count_left_out(motion);
            return false;
        }
        to = std::move(*tracks);
        contain_positions(to);
        return !to.empty();
    };
    if (Camera& camera = setting.camera; camera.motion != nullptr) {
        const double ahead = length(setting.look_at - camera.position);
        Mover mover{.names = {"position", "look_at", "up"},
                    .rest = {camera.position, setting.look_at, camera.up},
                    .tolerance = {fine, fine, 1e-4}};
        mover.state = [&](const Placement& place, const State&) -> std::optional<State> {
            const Vector position = place.origin - geometry_.moved, back = unit(place.z), up = unit(place.y);
            constexpr double k_least = 1e-6;
            if (!(length(cross(back, up)) > k_least)) return std::nullopt;
            return if_near({position, position - ahead * back, up});
        };
        mover.is_close = [&](const State& values, const Placement& place) {
            return length(values[0] - (place.origin - geometry_.moved)) <= close &&
                   is_within_angle(values[1] - values[0], -1 * place.z, 0.1) &&
                   is_within_angle(values[2], place.y, 0.5);
        };
        has_camera_ = take(*camera.motion, mover, camera.tracks);
    }
    for (std::size_t i = 0; i < model_.lights.size(); ++i) {
        Light& light = setting.lights[i];
        if (light.motion == nullptr) continue;
        // The light has been moved away from others.
        const Vector apart = light.position - model_.lights[i].position - geometry_.moved;
        Mover mover{.names = {light.has_position() ? "position" : nullptr,
                              light.type == "point" ? nullptr : "direction", nullptr},
                    .rest = {light.position, light.direction, Vector{}},
                    .tolerance = {fine, 1e-4, 1}};
        mover.state = [&](const Placement& place, const State&) -> std::optional<State> {
            const Vector direction = unit(-1 * place.z);
            if (length(direction) == 0) return std::nullopt;
            return if_near({place.origin + apart, direction, Vector{}});
        };
        mover.is_close = [&](const State& values, const Placement& place) {
            return length(values[0] - (place.origin + apart)) <= close &&
                   is_within_angle(values[1], -1 * place.z, 0.5);
        };
        if (take(*light.motion, mover, light.tracks)) ++lights_;
    }
    if (objects_ + lights_ > 0 || has_camera_) setting.frames = frames_of(model_.moving.length);
}

void Animator::note() {
    const Moving& moving = model_.moving;
    const std::size_t count = moving.names.size();
    if (count == 0) return;
    std::vector<std::string> taken, left;
    if (objects_ > 0) taken.push_back(counted(objects_, "object", "objects"));
    if (has_camera_) taken.emplace_back("the camera");
    if (lights_ > 0) taken.push_back(counted(lights_, "light", "lights"));
    if (taken.empty()) {
        return model_.note(
            count == 1 ? "its animation is left out; the model is shown at rest"
                       : fmt::format("its {} animations are left out; the model is shown at rest", count));
    }
    const auto leave = [&](std::size_t number, const char* one, const char* many) {
        if (number > 0) left.push_back(counted(number, one, many));
    };
    leave(moving.in_pieces, "object whose pieces move apart", "objects whose pieces move apart");
    leave(moving.undone, "motion that position, rotation and scale cannot describe",
          "motions that position, rotation and scale cannot describe");
    leave(moving.too_many, "motion with too many keys", "motions with too many keys");
    leave(moving.skins, "skin", "skins");
    leave(moving.weights, "channel of morph targets", "channels of morph targets");
    leave(moving.channels, "channel of another kind or damaged", "channels of other kinds or damaged");
    if (count > 1)
        left.push_back(fmt::format("the animation{} {}", count == 2 ? "" : "s",
                                   quoted({moving.names.begin() + 1, moving.names.end()})));
    std::string sentence =
        fmt::format("{} animation is imported for {}{}", count == 1 ? "its" : "its first",
                    fmt::join(taken, ", "), moving.has_splines ? ", with linear pieces for its splines" : "");
    if (!left.empty()) sentence += fmt::format("; left out: {}", fmt::join(left, ", "));
    model_.note(std::move(sentence));
}

}  // namespace importing
