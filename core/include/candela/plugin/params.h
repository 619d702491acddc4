// Parameters as a plugin declares them (`ParamSpec`), and their values as it receives them (`ParamValue`):
// plain data that crosses the plugin's boundary.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "candela/plugin/export.h"

namespace candela {

/// A list of numbers as a value. A class of its own because libstdc++ 12 assumes that a variant of trivial
/// types, strings and vectors is never valueless: if copying one runs out of memory, it destroys an object
/// that was never constructed.
struct NumberList : std::vector<float> {
    using std::vector<float>::vector;
    NumberList(std::vector<float> numbers) : std::vector<float>(std::move(numbers)) {}
};

enum class ParamType : int {
    real,       // one number
    integer,    // one integer
    boolean,    // true or false
    choice,     // one of the listed words
    text,       // any text
    file,       // a path, relative to the file that names it
    vector,     // three numbers
    point,      // three numbers, a position in the scene
    direction,  // three numbers, not all zero; received as a unit vector
    color,      // three integers 0-255; received as 0 to 1, decoded according to the image's color_management
    rgb,        // a number, or one per channel
    matrix,     // three rows of three numbers
    numbers,    // a list of numbers, at least one
};

/// "real", "integer", ...
CANDELA_EXPORT std::string_view name_of(ParamType type) noexcept;

/// A value as a plugin receives it; the type determines which member counts. Angles (unit "deg") are in
/// radians.
struct ParamValue {
    float number[9] = {};        // real (the first), vector, point, direction, color, rgb (three), matrix
                                 // (nine, row by row)
    std::int32_t integer = 0;    // integer, boolean, the index of a choice
    const char* text = nullptr;  // text, file (an absolute path); valid while the instance is being created
    std::span<const float> list{};  // numbers; valid while the instance is being created
};

inline constexpr float k_no_minimum = -std::numeric_limits<float>::infinity();
inline constexpr float k_no_maximum = std::numeric_limits<float>::infinity();

/// One parameter as a plugin declares it. Plain data with static lifetime; crosses the plugin's boundary.
struct ParamSpec {
    const char* name = "";
    ParamType type = ParamType::real;
    const char* unit = "";       // "m", "deg", or empty
    const char* meaning = "";    // one sentence
    bool required = false;       // no default: the scene must set it
    ParamValue default_value{};  // as written in a scene: degrees, colours 0-255
    float minimum = k_no_minimum;
    float maximum = k_no_maximum;
    bool minimum_excluded = false;
    bool maximum_excluded = false;
    std::span<const char* const> choices{};  // of a choice; of an integer if only some values are allowed
};

enum class RelationType : int { less, less_or_equal, sum_at_most_one };

/// A constraint between two parameters of one plugin; for rgb parameters, in each channel.
struct RelationSpec {
    RelationType type = RelationType::less_or_equal;
    const char* left = "";
    const char* right = "";
    bool only_warns = false;
    const char* meaning = "";  // why, as the end of the sentence "... because "
};

/// The value of one parameter in a preset.
struct PresetValue {
    const char* parameter = "";
    ParamValue value{};  // as written in a scene: degrees, colours 0-255
};

/// Values that belong together under a name that users choose, such as those of a material ("brass").
/// Parameters without a value in the preset are unchanged.
struct PresetSpec {
    const char* name = "";    // the name that users see; unique within the plugin
    const char* source = "";  // where the values come from: author, year, title
    std::span<const PresetValue> values{};
    bool has_color = false;  // of a reflection model: the preset includes the object's own colour
    float color[3] = {};     // 0-255
};

}  // namespace candela
