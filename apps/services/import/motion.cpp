#include "import/motion.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>

#include "import/placement.h"
#include "import/vectors.h"

namespace importing {

namespace {

constexpr double k_shortest = 1e-3;  // seconds; closer keys are not refined
constexpr double k_jump = 1e-5;      // seconds that a jump takes and by which it precedes its frame

State between(const State& a, const State& b, double s) {
    State result;
    for (std::size_t k = 0; k < 3; ++k) result[k] = a[k] + s * (b[k] - a[k]);
    return result;
}

bool is_near(const Vector& a, const Vector& b, double tolerance) {
    for (std::size_t k = 0; k < 3; ++k)
        if (!(std::abs(a[k] - b[k]) <= tolerance)) return false;
    return true;
}

class Sampler {
  public:
    Sampler(const Motion& motion, const Mover& mover, std::size_t& budget)
        : motion_(motion), mover_(mover), budget_(budget) {}

    bool sample() {
        State before = mover_.rest;
        double last = 0;
        for (std::size_t i = 0; i < motion_.times.size(); ++i) {
            const double time = motion_.times[i];
            const bool jumps =
                !motion_.has_steps_only && std::ranges::binary_search(motion_.jumps, time) && i > 0;
            bool is_there = true;
            if (i == 0 || motion_.has_steps_only) {
                is_there = add(time, time, before);
            } else if (jumps) {
                if (time - 2 * k_jump > last) is_there = refine(last, time - 2 * k_jump, before);
                is_there = is_there && add(time - k_jump, time, before);
            } else {
                is_there = refine(last, time, before);
            }
            if (!is_there) return false;
            last = time;
        }
        return true;
    }

    std::vector<std::pair<double, State>> keys;

  private:
    std::optional<State> state(double time, const State& before) {
        if (budget_ < motion_.cost) return std::nullopt;
        budget_ -= motion_.cost;
        return mover_.state(motion_.at(time), before);
    }

    bool add(double at, double time, State& before) {
        const std::optional<State> now = state(time, before);
        if (!now) return false;
        keys.emplace_back(at, *now);
        before = *now;
        return true;
    }

    bool refine(double from, double to, State& before) {
        const std::optional<State> end = state(to, before);
        if (!end) return false;
        if (to - from > k_shortest && !is_straight(from, to, before, *end)) {
            const double middle = 0.5 * (from + to);
            return refine(from, middle, before) && refine(middle, to, before);
        }
        keys.emplace_back(to, *end);
        before = *end;
        return true;
    }

    bool is_straight(double from, double to, const State& a, const State& b) {
        // A spline may cross the line at one of them, and a rotation may be back at its start.
        for (const double s : {0.5, 0.21, 0.82}) {
            if (budget_ < motion_.cost) return true;  // gives up: the caller finds the budget spent
            budget_ -= motion_.cost;
            if (!mover_.is_close(between(a, b, s), motion_.at(from + s * (to - from)))) return false;
        }
        return true;
    }

    const Motion& motion_;
    const Mover& mover_;
    std::size_t& budget_;
};

/// Without the keys that lie on the line between others.
std::vector<std::pair<double, Vector>> thinned(const std::vector<std::pair<double, Vector>>& keys, bool steps,
                                               double tolerance) {
    std::vector<std::pair<double, Vector>> result;
    std::size_t kept = 0;
    const auto is_spare = [&](std::size_t next) {  // whether all keys between `kept` and `next` are redundant
        constexpr std::size_t k_most = 256;
        if (next - kept > k_most) return false;
        for (std::size_t i = kept + 1; i < next; ++i) {
            const double s =
                steps ? 0 : (keys[i].first - keys[kept].first) / (keys[next].first - keys[kept].first);
            const Vector line = keys[kept].second + s * (keys[next].second - keys[kept].second);
            if (!is_near(keys[i].second, line, tolerance)) return false;
        }
        return true;
    };
    for (std::size_t i = 0; i < keys.size(); ++i) {
        const bool is_end = i == 0 || i + 1 == keys.size();
        if (!is_end && is_spare(i + 1)) continue;
        result.push_back(keys[i]);
        kept = i;
    }
    const auto is_first = [&](const auto& key) {
        return is_near(key.second, keys.front().second, tolerance);
    };
    if (std::ranges::all_of(result, is_first)) result.resize(1);
    return result;
}

Vector value_at(const Track& track, double time) {
    const auto next = std::ranges::upper_bound(track.keys, time, {}, &std::pair<double, Vector>::first);
    if (next == track.keys.begin()) return next->second;
    const auto before = std::prev(next);
    if (next == track.keys.end() || track.steps) return before->second;
    const double s = (time - before->first) / (next->first - before->first);
    return before->second + s * (next->second - before->second);
}

}  // namespace

std::optional<std::vector<Track>> tracks_of(const Motion& motion, const Mover& mover, std::size_t& budget) {
    Sampler sampler(motion, mover, budget);
    if (!sampler.sample()) return std::nullopt;
    std::vector<Track> tracks;
    for (std::size_t k = 0; k < 3; ++k) {
        if (mover.names[k] == nullptr) continue;
        std::vector<std::pair<double, Vector>> keys;
        for (const auto& [time, state] : sampler.keys) {
            // A step happens when its frame comes, whose time is rounded as well.
            const double rounded = motion.has_steps_only ? std::floor(time / k_jump + 0.1) * k_jump
                                                         : std::round(time * 1e6) / 1e6;
            if (!keys.empty() && rounded <= keys.back().first) keys.pop_back();
            keys.emplace_back(rounded, state[k]);
        }
        keys = thinned(keys, motion.has_steps_only, mover.tolerance[k]);
        if (keys.size() == 1 && is_near(keys[0].second, mover.rest[k], mover.tolerance[k])) continue;
        tracks.push_back({.name = mover.names[k], .steps = motion.has_steps_only, .keys = std::move(keys)});
    }
    return tracks;
}

State state_at(const std::vector<Track>& tracks, const Mover& mover, double time) {
    State result = mover.rest;
    for (const Track& track : tracks)
        for (std::size_t k = 0; k < 3; ++k)
            if (mover.names[k] != nullptr && track.name == mover.names[k]) result[k] = value_at(track, time);
    return result;
}

Placement placement_of(const State& state) {
    const auto& [position, rotation, scale] = state;
    constexpr double k_radians = std::numbers::pi / 180;
    const double sx = std::sin(rotation[0] * k_radians), cx = std::cos(rotation[0] * k_radians);
    const double sy = std::sin(rotation[1] * k_radians), cy = std::cos(rotation[1] * k_radians);
    const double sz = std::sin(rotation[2] * k_radians), cz = std::cos(rotation[2] * k_radians);
    return {scale[0] * Vector{cz * cy, sz * cy, -sy},
            scale[1] * Vector{cz * sy * sx - sz * cx, sz * sy * sx + cz * cx, cy * sx},
            scale[2] * Vector{cz * sy * cx + sz * sx, sz * sy * cx - cz * sx, cy * cx}, position};
}

std::optional<State> state_of(const Placement& place, const State& before) {
    const Vector scale{length(place.x), length(place.y), length(place.z)};
    const auto [least, most] = std::ranges::minmax(scale);
    constexpr double k_flat = 1e-6, k_farthest = 1e9;
    if (!(least > k_flat * most) || !(most < k_farthest) || !(least > 1 / k_farthest)) return std::nullopt;
    if (!is_near(place.origin, {}, k_farthest)) return std::nullopt;
    const Vector x = unit(place.x), y = unit(place.y), z = unit(place.z);
    constexpr double k_degrees = 180 / std::numbers::pi;
    const double level = std::hypot(x[0], x[1]);
    std::array<Vector, 2> candidates{};
    constexpr double k_upright = 1e-6;
    if (level > k_upright) {
        const Vector turned{std::atan2(y[2], z[2]), std::atan2(-x[2], level), std::atan2(x[1], x[0])};
        candidates[0] = k_degrees * turned;
        candidates[1] = {candidates[0][0] + 180, 180 - candidates[0][1], candidates[0][2] + 180};
    } else {  // x and z now rotate about the same axis
        const double about_z = before[1][2] / k_degrees, c = std::cos(about_z), s = std::sin(about_z);
        const double about_x = std::atan2(s * z[0] - c * z[1], c * y[1] - s * y[0]);
        candidates.fill({about_x * k_degrees, x[2] < 0 ? 90.0 : -90.0, before[1][2]});
    }
    Vector nearest{};
    double shortest = HUGE_VAL;
    for (Vector& candidate : candidates) {
        double distance = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            candidate[k] += 360 * std::round((before[1][k] - candidate[k]) / 360);
            candidate[k] = std::round(candidate[k] * 1e5) / 1e5;
            distance += std::abs(candidate[k] - before[1][k]);
        }
        if (distance < shortest) nearest = candidate, shortest = distance;
    }
    const State result{place.origin, nearest, scale};
    const Placement again = placement_of(result);
    constexpr double k_hardly_any = 2e-4;
    const bool is_same = is_near(again.x, place.x, k_hardly_any * most) &&
                         is_near(again.y, place.y, k_hardly_any * most) &&
                         is_near(again.z, place.z, k_hardly_any * most);
    return is_same ? std::optional(result) : std::nullopt;
}

}  // namespace importing
