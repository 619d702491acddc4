// Parameter schemas: what a plugin or a table of the scene file may be told. Typed once; manifests,
// validation, listings and documentation all come from here.
//
// `ParamSpec` is the plain form that a plugin hands over; `Parameter` is the same with its own memory, as
// read from a manifest. `ParamValue` is one value as a plugin receives it; `Value` is one value as a person
// wrote it.
module;

#include "candela/api.h"

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

export module candela.params;

import candela.math;

export namespace candela {

enum class ParamType : int {
    real,       // one number
    integer,    // one whole number
    boolean,    // true or false
    choice,     // one of the listed words
    text,       // any text
    file,       // a path, relative to the file that names it
    vector,     // three numbers
    point,      // three numbers, a place in the scene
    direction,  // three numbers, not all zero; arrives as a unit vector
    color,      // three whole numbers 0-255; arrives as 0 to 1, decoded as the image's color_management says
    triple,     // a number, or one per channel
};

/// A value as a plugin receives it; which member counts follows from the type. Angles (unit "deg") arrive in
/// radians.
struct ParamValue {
    float number[3] = {0, 0, 0};  // real (the first), vector, point, direction, color, triple
    std::int32_t integer = 0;     // integer, boolean, the index of a choice
    const char* text = nullptr;  // text, file (an absolute path); lives as long as the instance is being made
};

inline constexpr float k_no_minimum = -std::numeric_limits<float>::infinity();
inline constexpr float k_no_maximum = std::numeric_limits<float>::infinity();

/// One parameter as a plugin declares it. Plain data with static lifetime; crosses the plugin's boundary.
struct ParamSpec {
    const char* name = "";
    ParamType type = ParamType::real;
    const char* unit = "";     // "m", "deg", or empty
    const char* meaning = "";  // one sentence
    bool required = false;     // no default: the scene must say
    ParamValue fallback{};     // the default, as a person writes it: degrees, colours 0-255
    float minimum = k_no_minimum;
    float maximum = k_no_maximum;
    bool minimum_excluded = false;
    bool maximum_excluded = false;
    std::span<const char* const> choices{};  // of a choice; of an integer, where only some are allowed
};

enum class RelationType : int { less, less_or_equal, sum_at_most_one };

/// What must hold between two parameters of one plugin; of triples, in each channel.
struct RelationSpec {
    RelationType type = RelationType::less_or_equal;
    const char* left = "";
    const char* right = "";
    bool only_warns = false;
    const char* meaning = "";  // why, as the end of the sentence "... because "
};

/// A value as a person writes it. Vec3 holds vector, point, direction, color and triple.
using Value = std::variant<bool, std::int64_t, double, std::string, Vec3>;

/// `ParamSpec` with its own memory.
struct Parameter {
    std::string name{};
    ParamType type = ParamType::real;
    std::string unit{};
    std::string meaning{};
    std::optional<Value> fallback{};  // none: required
    float minimum = k_no_minimum;
    float maximum = k_no_maximum;
    bool minimum_excluded = false;
    bool maximum_excluded = false;
    std::vector<std::string> choices{};

    friend bool operator==(const Parameter&, const Parameter&) = default;
};

/// `RelationSpec` with its own memory.
struct Relation {
    RelationType type = RelationType::less_or_equal;
    std::string left;
    std::string right;
    bool only_warns = false;
    std::string meaning;

    friend bool operator==(const Relation&, const Relation&) = default;
};

CANDELA_API Parameter parameter_of(const ParamSpec& spec);
CANDELA_API Relation relation_of(const RelationSpec& spec);

CANDELA_API std::string_view name_of(ParamType type) noexcept;
CANDELA_API std::optional<ParamType> param_type_named(std::string_view name) noexcept;
CANDELA_API std::string_view name_of(RelationType type) noexcept;
CANDELA_API std::optional<RelationType> relation_type_named(std::string_view name) noexcept;

/// What is expected of a value: "a number, at least 0", "three whole numbers 0-255", "one of 'a', 'b'".
CANDELA_API std::string expectation(const Parameter& parameter);

/// The range alone: "0 to 1", "greater than 0", or empty.
CANDELA_API std::string range_text(const Parameter& parameter);

/// A value as a person would write it in a scene file.
CANDELA_API std::string text_of(const Value& value);

/// What a relation asks for: "inner_angle does not exceed outer_angle: the cone of full light …".
CANDELA_API std::string text_of(const Relation& relation);

/// What is wrong with `value` (which already has the parameter's type), or nothing.
CANDELA_API std::optional<std::string> complaint(const Parameter& parameter, const Value& value);

/// How scene colours are read and 8-bit pictures are written (SPEC of the scene file, color_management).
enum class ColorEncoding : int {
    srgb,  // decoded before lighting, encoded again in 8-bit pictures
    none,  // taken as they are
};

/// The sRGB transfer functions (IEC 61966-2-1:1999): encoded to linear and back, per channel, 0 to 1.
CANDELA_API float srgb_to_linear(float encoded) noexcept;
CANDELA_API float linear_to_srgb(float linear) noexcept;

/// A scene colour 0-255 as intensities 0 to 1; 256 counts as 255.
CANDELA_API Rgb decoded(Vec3 color, ColorEncoding encoding) noexcept;

/// A schema that many sets have in common. Never null.
using SharedSchema = std::shared_ptr<const std::vector<Parameter>>;

/// The values of one schema: every parameter has one, except required ones not yet set.
class CANDELA_API ParamSet {
  public:
    ParamSet();
    explicit ParamSet(std::vector<Parameter> schema);
    explicit ParamSet(SharedSchema schema);

    const std::vector<Parameter>& schema() const noexcept { return *schema_; }
    std::size_t index_of(std::string_view name) const noexcept;  // schema().size() where there is none

    /// Throws std::invalid_argument where there is no such parameter or the value does not fit it.
    void set(std::string_view name, Value value);
    void set(std::size_t index, Value value) { values_[index] = std::move(value); }

    /// The value, or nothing for a required one that is not set.
    const std::optional<Value>& get(std::size_t index) const { return values_[index]; }
    /// Throws std::invalid_argument where there is no such parameter or it is not set.
    const Value& get(std::string_view name) const;

    /// The values as a plugin receives them, in the schema's order. The texts point into this set.
    /// Throws std::invalid_argument where a required one is not set.
    std::vector<ParamValue> delivered(ColorEncoding encoding) const;

    /// The same schema and the same values.
    friend CANDELA_API bool operator==(const ParamSet& a, const ParamSet& b);

  private:
    SharedSchema schema_;
    std::vector<std::optional<Value>> values_;
};

/// What is wrong between two parameters of `set`, or nothing.
CANDELA_API std::optional<std::string> complaint(const Relation& relation, const ParamSet& set);

}  // namespace candela
