// The values of a scene that change from frame to frame.
module;

#include "candela/plugin/export.h"

#include <optional>
#include <string>
#include <vector>

export module candela.scene:animation;

import candela.plugins;
import candela.util;

export namespace candela {

/// How a value changes from one key to the next.
enum class Interpolation : int {
    linear,  // in a straight line
    step,    // it stays until the next key
    smooth,  // along a Catmull-Rom spline through all keys
};

/// The value of a track at one time.
struct Key {
    double time = 0;  // seconds
    Value value;
    SourceLocation place{};  // of the value

    /// Ignores positions in the file.
    friend CANDELA_EXPORT bool operator==(const Key& a, const Key& b);
};

/// One value of the scene over time.
struct Track {
    std::string path;  // as in Setting
    ParamType type = ParamType::real;
    std::vector<Key> keys;  // at least one, their times strictly increasing, their values of the same type
    Interpolation interpolation = Interpolation::linear;

    friend CANDELA_EXPORT bool operator==(const Track& a, const Track& b);
};

/// The track's value at a time in seconds: the first key's before it, the last key's after it. Colours and
/// integers are rounded. Smooth tracks follow the cubic Hermite spline whose tangents are those of Catmull
/// and Rom (1974) for keys at any distance: the slope between the two neighbours; at the ends, that to the
/// only neighbour. The spline may exceed the values of its keys.
CANDELA_EXPORT Value value_at(const Track& track, double time);

/// The observer's path around its look-at point, about the up direction, at constant distance and height.
struct Orbit {
    double turns = 1;  // over all frames; counter-clockwise seen from above, clockwise if negative

    friend inline bool operator==(const Orbit& a, const Orbit& b) { return a.turns == b.turns; }
};

/// Frames are numbered from 0; frame i is at i / fps seconds.
struct Animation {
    int frames = 1;
    double fps = 24;
    std::vector<Track> tracks;
    std::optional<Orbit> orbit{};

    inline double time_of(int frame) const { return frame / fps; }

    friend CANDELA_EXPORT bool operator==(const Animation& a, const Animation& b);
};

}  // namespace candela
