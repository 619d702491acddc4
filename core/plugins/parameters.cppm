// Parameters, their values and the relations between them on the host's side: read from manifests, checked,
// quoted in messages.
module;

#include "candela/plugin/export.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

export module candela.plugins:parameters;

export import candela.api;

export namespace candela {

/// A value as written in a scene. Vec3 holds vector, point, direction, color and rgb; the last two
/// alternatives hold matrix and numbers.
using Value = std::variant<bool, std::int64_t, double, std::string, Vec3, Matrix, NumberList>;

/// The number with the fewest decimals that is `x` as a float: 0.1, not 0.10000000149011612.
CANDELA_EXPORT double shortest(float x);

/// The ways to write a number, apart from plain ones.
enum class Notation : int {
    plain,
    exposure,     // "EV 12", or { aperture, time, iso }
    intensity,    // of a light that shines in all directions: "800 lm", "1200 cd", "60 W"
    cone,         // of one that shines into a cone: the same
    illuminance,  // of one from far away: "5 klx"
};

/// A `ParamSpec` that owns its memory.
struct Parameter {
    std::string name{};
    ParamType type = ParamType::real;
    std::string unit{};
    std::string meaning{};
    std::optional<Value> default_value{};  // none: required
    float minimum = k_no_minimum;
    float maximum = k_no_maximum;
    bool minimum_excluded = false;
    bool maximum_excluded = false;
    std::vector<std::string> choices{};
    Notation notation = Notation::plain;  // the host's addition

    friend bool operator==(const Parameter&, const Parameter&) = default;
};

/// A `RelationSpec` that owns its memory.
struct Relation {
    RelationType type = RelationType::less_or_equal;
    std::string left;
    std::string right;
    bool only_warns = false;
    std::string meaning;

    friend bool operator==(const Relation&, const Relation&) = default;
};

/// A `PresetSpec` that owns its memory.
struct Preset {
    std::string name;
    std::string source;
    std::vector<std::pair<std::string, Value>> values;  // by parameter
    std::optional<Vec3> color;                          // of the object, 0-255

    friend bool operator==(const Preset&, const Preset&) = default;
};

/// A value in the form that crosses to plugins, but as written: degrees, colours 0-255. Texts and lists point
/// into `value`.
CANDELA_EXPORT ParamValue written_value(const Value& value, const Parameter& parameter);

CANDELA_EXPORT Parameter parameter_of(const ParamSpec& spec);
/// Throws Error (failure) if the preset sets a parameter that does not exist.
CANDELA_EXPORT Preset preset_of(const PresetSpec& spec, std::span<const ParamSpec> parameters);
CANDELA_EXPORT Relation relation_of(const RelationSpec& spec);

CANDELA_EXPORT std::optional<ParamType> param_type_named(std::string_view name) noexcept;
CANDELA_EXPORT std::string_view name_of(RelationType type) noexcept;
CANDELA_EXPORT std::optional<RelationType> relation_type_named(std::string_view name) noexcept;

/// The constraint on a value: "a number, at least 0", "three integers 0-255", "one of 'a', 'b'".
CANDELA_EXPORT std::string constraint_text(const Parameter& parameter);

/// The range alone: "0 to 1", "greater than 0", or empty.
CANDELA_EXPORT std::string range_text(const Parameter& parameter);

/// A value in messages: 2, [1, 0.5, 0].
CANDELA_EXPORT std::string text_of(const Value& value);

/// A value of that type as a scene has it: 2.0, [1.0, 0.5, 0.0]. Three equal numbers of an `rgb` are one; a
/// colour's channels are rounded to integers.
CANDELA_EXPORT std::string toml_text(const Value& value, ParamType type);

/// The requirement of a relation: "inner_angle does not exceed outer_angle: the cone of full light …".
CANDELA_EXPORT std::string text_of(const Relation& relation);

/// Why `value`, which already has the parameter's type, is invalid, or nothing. `written`: the author's
/// spelling of it, for the message; may be empty.
CANDELA_EXPORT std::optional<std::string> validation_error(const Parameter& parameter, const Value& value,
                                                           std::string_view written = {});

/// A schema shared by many sets. Never null.
using SharedSchema = std::shared_ptr<const std::vector<Parameter>>;

/// The values of one schema: every parameter has one, except required ones that are not yet set.
class CANDELA_EXPORT ParamSet {
  public:
    ParamSet();
    explicit ParamSet(std::vector<Parameter> schema);
    explicit ParamSet(SharedSchema schema);

    const std::vector<Parameter>& schema() const noexcept { return *schema_; }
    std::size_t index_of(std::string_view name) const noexcept;  // schema().size() if there is none

    /// Throws std::invalid_argument if there is no such parameter or the value is invalid.
    void set(std::string_view name, Value value);
    void set(std::size_t index, Value value) { values_[index] = std::move(value); }

    /// The value, or nothing if the parameter is required and not set.
    const std::optional<Value>& get(std::size_t index) const { return values_[index]; }
    /// Throws std::invalid_argument if there is no such parameter or it is not set.
    const Value& get(std::string_view name) const;

    /// The values as a plugin receives them, in the schema's order. Texts point into this set. Throws
    /// std::invalid_argument if a required value is not set.
    std::vector<ParamValue> runtime(ColorEncoding encoding) const;

    /// Equal schemas and equal values.
    friend CANDELA_EXPORT bool operator==(const ParamSet& a, const ParamSet& b);

  private:
    SharedSchema schema_;
    std::vector<std::optional<Value>> values_;
};

/// How `set` violates the relation, or nothing.
CANDELA_EXPORT std::optional<std::string> validation_error(const Relation& relation, const ParamSet& set);

}  // namespace candela

namespace candela {

/// A declared value as users write it.
Value value_of(const ParamSpec& spec, const ParamValue& value);

}  // namespace candela
