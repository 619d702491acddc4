// Motions as a scene's animated values.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "import/model.h"

namespace importing {

using State = std::array<Vector, 3>;

/// The values that describe a moving thing in a scene: up to three.
struct Mover {
    std::array<const char*, 3> names{};  // null: unused
    State rest{};
    std::array<double, 3> tolerance{};  // of the values' numbers
    /// The values for a placement, as close to `before` as possible; nothing if no values describe it.
    std::function<std::optional<State>(const Placement& place, const State& before)> state{};
    /// Whether values differ negligibly from the placement that they describe.
    std::function<bool(const State& values, const Placement& place)> is_close{};
};

/// The values that change; empty if it rests. Adds keys to the motion's own so that the values follow it
/// closely between keys. Nothing if no values describe the motion, or if it takes more work than `budget`,
/// which is reduced by the work done.
std::optional<std::vector<Track>> tracks_of(const Motion& motion, const Mover& mover, std::size_t& budget);

/// The values at a given time.
State state_at(const std::vector<Track>& tracks, const Mover& mover, double time);

/// The placement described by an object's position, rotation and scale.
Placement placement_of(const State& state);

/// The inverse; the rotation is as close to `before` as possible, even beyond 360 degrees.
std::optional<State> state_of(const Placement& place, const State& before);

}  // namespace importing
