// A plugin's parameters, each mapped to a member of a struct.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <type_traits>
#include <vector>

#include "candela/kernel/kernel.h"
#include "candela/plugin/params.h"

namespace candela::sdk {

using kernel::mat3;
using kernel::Table;
using kernel::vec3;

/// A parameter and the member of `Params` that receives it.
template <class Params>
struct Field {
    ParamSpec spec;
    float Params::* real = nullptr;
    std::int32_t Params::* integer = nullptr;
    vec3 Params::* vector = nullptr;
    const char* Params::* text = nullptr;
    mat3 Params::* matrix = nullptr;
    Table Params::* table = nullptr;
    std::vector<float> (*read_table)(const char* path) = nullptr;  // of a table that is made from a file
    bool makes_without_file = false;  // read_table is also called, with "", if no file is given

    void store(Params& params, const ParamValue& value) const {
        if (real != nullptr) params.*real = value.number[0];
        if (integer != nullptr) params.*integer = value.integer;
        // Otherwise g++ warns about a member past the end of a struct too small to have one.
        if constexpr (sizeof(Params) >= sizeof(vec3)) {
            if (vector != nullptr) params.*vector = vec3(value.number[0], value.number[1], value.number[2]);
        }
        if constexpr (sizeof(Params) >= sizeof(mat3)) {
            if (matrix != nullptr) {
                const float* const m = value.number;
                params.*matrix = mat3(vec3(m[0], m[3], m[6]), vec3(m[1], m[4], m[7]), vec3(m[2], m[5], m[8]));
            }
        }
        if (text != nullptr) params.*text = value.text;
    }

    /// The numbers of the member, if it is a table. Throws std::exception if the file has none.
    std::vector<float> numbers_of(const ParamValue& value) const {
        if (table == nullptr) return {};
        if (read_table == nullptr) return {value.list.begin(), value.list.end()};
        const bool is_given = value.text != nullptr && *value.text != '\0';
        if (is_given) return read_table(value.text);
        return makes_without_file ? read_table("") : std::vector<float>();
    }

    const void* member_of(const Params& params) const {
        if (real != nullptr) return &(params.*real);
        if (integer != nullptr) return &(params.*integer);
        if (vector != nullptr) return &(params.*vector);
        if (matrix != nullptr) return &(params.*matrix);
        if (table != nullptr) return &(params.*table);
        return text != nullptr ? static_cast<const void*>(&(params.*text)) : nullptr;
    }

    // The rest of the declaration, after the type of value: real(...).minimum(0).unit("m").

    constexpr Field minimum(float low) const {
        return with([&](ParamSpec& s) { s.minimum = low; });
    }
    constexpr Field maximum(float high) const {
        return with([&](ParamSpec& s) { s.maximum = high; });
    }
    constexpr Field range(float low, float high) const { return minimum(low).maximum(high); }
    constexpr Field above(float low) const {
        return with([&](ParamSpec& s) { s.minimum = low, s.minimum_excluded = true; });
    }
    constexpr Field below(float high) const {
        return with([&](ParamSpec& s) { s.maximum = high, s.maximum_excluded = true; });
    }
    constexpr Field unit(const char* name) const {
        return with([&](ParamSpec& s) { s.unit = name; });
    }
    constexpr Field required() const {
        return with([&](ParamSpec& s) { s.required = true; });
    }
    /// For a file: if it is not set, the text is empty or the table has no numbers.
    constexpr Field optional() const {
        return with([&](ParamSpec& s) { s.required = false; });
    }
    /// Like optional(), but `read` makes the table of "".
    constexpr Field made_without_file() const {
        Field result = optional();
        result.makes_without_file = true;
        return result;
    }

  private:
    template <class Change>
    constexpr Field with(Change change) const {
        Field result = *this;
        change(result.spec);
        return result;
    }
};

// Declarations. `meaning` is one sentence; a default is given as written in a scene: degrees, colours 0-255.

template <class P>
constexpr Field<P> real(float P::* member, const char* name, float default_value, const char* meaning) {
    return {.spec = {.name = name,
                     .type = ParamType::real,
                     .meaning = meaning,
                     .default_value = {{default_value}}},
            .real = member};
}
/// In degrees in the scene, in radians for the plugin.
template <class P>
constexpr Field<P> angle(float P::* member, const char* name, float default_value, const char* meaning) {
    return real(member, name, default_value, meaning).unit("deg");
}
template <class P>
constexpr Field<P> integer(std::int32_t P::* member, const char* name, std::int32_t default_value,
                           const char* meaning) {
    return {.spec = {.name = name,
                     .type = ParamType::integer,
                     .meaning = meaning,
                     .default_value = {.integer = default_value}},
            .integer = member};
}
/// One of `words`; the member receives its index, and the default is the first.
template <class P>
constexpr Field<P> choice(std::int32_t P::* member, const char* name, std::span<const char* const> words,
                          const char* meaning) {
    return {.spec = {.name = name, .type = ParamType::choice, .meaning = meaning, .choices = words},
            .integer = member};
}
template <class P>
constexpr Field<P> boolean(std::int32_t P::* member, const char* name, bool default_value,
                           const char* meaning) {
    return {.spec = {.name = name,
                     .type = ParamType::boolean,
                     .meaning = meaning,
                     .default_value = {.integer = default_value ? 1 : 0}},
            .integer = member};
}
template <class P>
constexpr Field<P> three(vec3 P::* member, ParamType type, const char* name, vec3 default_value,
                         const char* meaning) {
    return {.spec = {.name = name,
                     .type = type,
                     .meaning = meaning,
                     .default_value = {{default_value.x, default_value.y, default_value.z}}},
            .vector = member};
}
template <class P>
constexpr Field<P> color(vec3 P::* member, const char* name, vec3 default_value, const char* meaning) {
    return three(member, ParamType::color, name, default_value, meaning);
}
template <class P>
constexpr Field<P> point(vec3 P::* member, const char* name, const char* meaning) {
    return three(member, ParamType::point, name, vec3(0.0f), meaning).required().unit("m");
}
template <class P>
constexpr Field<P> direction(vec3 P::* member, const char* name, const char* meaning) {
    return three(member, ParamType::direction, name, vec3(0.0f), meaning).required();
}
/// A number, or one per channel, 0 to 1.
template <class P>
constexpr Field<P> coefficient(vec3 P::* member, const char* name, float default_value, const char* meaning) {
    return three(member, ParamType::rgb, name, vec3(default_value), meaning).range(0, 1);
}
template <class P>
constexpr Field<P> file(const char* P::* member, const char* name, const char* meaning) {
    return {.spec = {.name = name, .type = ParamType::file, .meaning = meaning, .required = true},
            .text = member};
}

/// Three rows of three numbers, 'm * v' in the kernel; the default, row by row, is the identity.
template <class P>
constexpr Field<P> matrix(mat3 P::* member, const char* name, const char* meaning,
                          const Matrix& rows = {1, 0, 0, 0, 1, 0, 0, 0, 1}) {
    Field<P> field{.spec = {.name = name, .type = ParamType::matrix, .meaning = meaning}, .matrix = member};
    std::copy(rows.begin(), rows.end(), field.spec.default_value.number);
    return field;
}
/// A list of numbers. `default_value` is an array with the lifetime of the library.
template <class P>
constexpr Field<P> numbers(Table P::* member, const char* name, std::span<const float> default_value,
                           const char* meaning) {
    return {.spec = {.name = name,
                     .type = ParamType::numbers,
                     .meaning = meaning,
                     .default_value = {.list = default_value}},
            .table = member};
}
/// A file; the member receives the table that `read` makes of it, once per instance. `read` may throw
/// std::exception.
template <class P>
constexpr Field<P> file_table(Table P::* member, const char* name,
                              std::vector<float> (*read)(const char* path), const char* meaning) {
    return {.spec = {.name = name, .type = ParamType::file, .meaning = meaning, .required = true},
            .table = member,
            .read_table = read};
}

template <class Params, std::size_t count>
Params params_from(const std::array<Field<Params>, count>& fields, std::span<const ParamValue> values) {
    Params params{};
    for (std::size_t i = 0; i < count; ++i) fields[i].store(params, values[i]);
    return params;
}

template <class Params, std::size_t count>
constexpr bool have_tables(const std::array<Field<Params>, count>& fields) {
    for (const Field<Params>& field : fields) {
        if (field.table != nullptr) return true;
    }
    return false;
}

/// The `Params` of a plugin without parameters.
struct NoParams {};
inline constexpr std::array<Field<NoParams>, 0> k_no_fields{};

/// Whether every member of a kernel's struct is a parameter. (Its members are numbers, and tables with the
/// same alignment, so there is no padding.)
template <class Params, std::size_t count>
constexpr bool fill_all_members(const std::array<Field<Params>, count>& fields) {
    std::size_t size = 0;
    for (const Field<Params>& field : fields) {
        size += field.vector != nullptr   ? sizeof(vec3)
                : field.matrix != nullptr ? sizeof(mat3)
                : field.table != nullptr  ? sizeof(Table)
                                          : sizeof(float);
    }
    return count == 0 ? std::is_empty_v<Params> : size == sizeof(Params);
}

/// The indices of the fields in the order of their members.
template <class Params, std::size_t count>
std::array<std::size_t, count> by_member(const std::array<Field<Params>, count>& fields) {
    const Params params{};
    std::array<const void*, count> addresses{};
    std::array<std::size_t, count> order{};
    for (std::size_t i = 0; i < count; ++i) {
        addresses[i] = fields[i].member_of(params);
        order[i] = i;
    }
    std::ranges::sort(order, std::ranges::less(), [&](std::size_t i) { return addresses[i]; });
    return order;
}

template <std::size_t count, class Params>
constexpr std::array<ParamSpec, count> specs_of(const std::array<Field<Params>, count>& fields) {
    std::array<ParamSpec, count> specs{};
    for (std::size_t i = 0; i < count; ++i) specs[i] = fields[i].spec;
    return specs;
}

template <class... Fields>
constexpr auto fields(Fields... all) {
    return std::array<std::common_type_t<Fields...>, sizeof...(Fields)>{all...};
}

}  // namespace candela::sdk
