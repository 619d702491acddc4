// Tracks over time.
module;

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <string>
#include <variant>
#include <vector>

module candela.scene;

import candela.api;
import candela.plugins;

namespace candela {

namespace {

using Numbers = std::vector<double>;

/// The numbers that make up a value; none if it cannot be interpolated.
Numbers numbers_of(const Value& value) {
    struct Visitor {
        Numbers operator()(bool) const { return {}; }
        Numbers operator()(const std::string&) const { return {}; }
        Numbers operator()(std::int64_t i) const { return {static_cast<double>(i)}; }
        Numbers operator()(double x) const { return {x}; }
        Numbers operator()(Vec3 v) const { return {v.x, v.y, v.z}; }
        Numbers operator()(const Matrix& m) const { return {m.begin(), m.end()}; }
        Numbers operator()(const NumberList& list) const { return {list.begin(), list.end()}; }
    };
    return std::visit(Visitor{}, value);
}

/// A value like `model`, made of these numbers.
Value made_of(const Numbers& numbers, const Value& model, ParamType type) {
    struct Visitor {
        const Numbers& x;
        bool rounded;

        float number(std::size_t i) const { return static_cast<float>(rounded ? std::round(x[i]) : x[i]); }
        Value operator()(bool b) const { return b; }
        Value operator()(const std::string& text) const { return text; }
        Value operator()(std::int64_t) const { return static_cast<std::int64_t>(std::llround(x[0])); }
        Value operator()(double) const { return x[0]; }
        Value operator()(Vec3) const { return Vec3{number(0), number(1), number(2)}; }
        Value operator()(Matrix m) const {
            for (std::size_t i = 0; i < m.size(); ++i) m[i] = number(i);
            return m;
        }
        Value operator()(NumberList list) const {
            for (std::size_t i = 0; i < list.size(); ++i) list[i] = number(i);
            return list;
        }
    };
    return std::visit(Visitor{numbers, type == ParamType::color}, model);
}

/// The slope at key `i` of number `n`, per second.
double slope(const std::vector<Key>& keys, std::size_t i, std::size_t n) {
    const std::size_t before = i > 0 ? i - 1 : i;
    const std::size_t after = std::min(i + 1, keys.size() - 1);
    return (numbers_of(keys[after].value)[n] - numbers_of(keys[before].value)[n]) /
           (keys[after].time - keys[before].time);
}

}  // namespace

bool operator==(const Key& a, const Key& b) { return a.time == b.time && a.value == b.value; }

bool operator==(const Track& a, const Track& b) {
    return a.path == b.path && a.type == b.type && a.interpolation == b.interpolation && a.keys == b.keys;
}

bool operator==(const Animation& a, const Animation& b) {
    // clang 22 does not find Orbit's own comparison for std::optional's.
    const bool is_same_orbit = a.orbit && b.orbit ? *a.orbit == *b.orbit : !a.orbit && !b.orbit;
    return a.frames == b.frames && a.fps == b.fps && a.tracks == b.tracks && is_same_orbit;
}

Value value_at(const Track& track, double time) {
    const std::vector<Key>& keys = track.keys;
    const auto next = std::ranges::upper_bound(keys, time, {}, &Key::time);
    if (next == keys.begin()) return keys.front().value;
    if (next == keys.end() || track.interpolation == Interpolation::step) return std::prev(next)->value;
    const auto i = static_cast<std::size_t>(next - keys.begin()) - 1;
    const Numbers from = numbers_of(keys[i].value), to = numbers_of(keys[i + 1].value);
    const double span = keys[i + 1].time - keys[i].time;
    const double s = (time - keys[i].time) / span;
    Numbers between(from.size());
    for (std::size_t n = 0; n < between.size(); ++n) {
        const double a = from[n], b = to[n];
        if (track.interpolation == Interpolation::linear) {
            between[n] = std::lerp(a, b, s);
        } else {
            const double u = 1 - s;
            between[n] = a * (1 + 2 * s) * u * u + b * s * s * (3 - 2 * s) +
                         span * s * u * (slope(keys, i, n) * u - slope(keys, i + 1, n) * s);
        }
    }
    return made_of(between, keys[i].value, track.type);
}

}  // namespace candela
