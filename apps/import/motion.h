// Motions as values of a scene that change with time.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "import/model.h"

namespace importing {

using State = std::array<Vector, 3>;

/// What a scene has of something that moves: up to three values.
struct Mover {
    std::array<const char*, 3> names{};  // null: there is no such value
    State rest{};
    std::array<double, 3> tolerance{};  // of their numbers
    /// The values at a placement, as near to those before as they can be; nothing where there are none.
    std::function<std::optional<State>(const Placement& place, const State& before)> state{};
    /// Whether there is hardly a difference between values and the placement that they stand for.
    std::function<bool(const State& values, const Placement& place)> is_close{};
};

/// The values that change; empty where it rests. Between two keys they follow the motion closely, so that
/// there are more keys than the motion has. Nothing where the motion leads to what no values describe, or to
/// more work than is in `budget`, from which it is taken.
std::optional<std::vector<Track>> tracks_of(const Motion& motion, const Mover& mover, std::size_t& budget);

/// The values at a time.
State state_at(const std::vector<Track>& tracks, const Mover& mover, double time);

/// The placement that an object's position, rotation and scale stand for.
Placement placement_of(const State& state);

/// And the other way round; the rotation is as near to `before` as it can be, beyond 360 degrees too.
std::optional<State> state_of(const Placement& place, const State& before);

}  // namespace importing
