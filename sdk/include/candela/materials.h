// The materials of the points in a reflection model's loops: the same one everywhere, or one for each point.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "candela/fields.h"
#include "candela/kernel/kernel.h"
#include "candela/reflection_model.h"

namespace candela::sdk {

/// The number of points that pass through a loop at once: few enough to stay in the first-level cache, enough
/// to interleave four vectors.
inline constexpr std::size_t k_pass_size = 64;

/// The same material at each point.
template <class Material>
struct UniformMaterial {
    struct Pass {};

    Material material;

    CANDELA_KERNEL_INLINE const UniformMaterial& pass(std::size_t, Pass&) const { return *this; }
    CANDELA_KERNEL_INLINE const Material& operator[](std::size_t) const { return material; }
};

/// Structs of 32-bit numbers as an array for each number, so that loops over points read whole vectors.
template <class Struct>
class Columns {
  public:
    static constexpr std::size_t k_count = sizeof(Struct) / sizeof(float);

    CANDELA_KERNEL_INLINE Struct operator[](std::size_t i) const {
        return at(i, std::make_index_sequence<k_count>());
    }
    CANDELA_KERNEL_INLINE void set(std::size_t i, const Struct& value) {
        float numbers[k_count];
        __builtin_memcpy(numbers, static_cast<const void*>(&value), sizeof numbers);
        for (std::size_t k = 0; k < k_count; ++k) column[k][i] = numbers[k];
    }

    alignas(64) float column[k_count][k_pass_size];

  private:
    template <std::size_t... k>
    CANDELA_KERNEL_INLINE Struct at(std::size_t i, std::index_sequence<k...>) const {
        const float numbers[k_count] = {column[k][i]...};
        Struct value;
        __builtin_memcpy(static_cast<void*>(&value), numbers, sizeof numbers);
        return value;
    }
};

/// A number in the struct of parameters that is different at each point.
struct VaryingNumber {
    std::size_t column = 0;
    const float* values = nullptr;  // of all points
};

/// A material for each point: what `Preparation` makes of its parameters.
template <class Params, class Preparation>
struct VaryingMaterials {
    using Material = std::remove_cvref_t<decltype(Preparation::run(std::declval<const Params&>()))>;
    static constexpr bool k_is_prepared = !std::is_same_v<Material, Params>;

    struct Pass {
        Columns<Params> params;
        std::conditional_t<k_is_prepared, Columns<Material>, std::array<char, 0>> prepared;
    };

    Params params;  // where they do not vary
    const VaryingNumber* numbers = nullptr;
    std::size_t number_count = 0;
    std::size_t point_count = 0;

    /// The materials of the points from `first` on; the last point's are repeated to fill the pass.
    CANDELA_KERNEL_INLINE const auto& pass(std::size_t first, Pass& pass) const {
        if (first == 0) {
            for (std::size_t i = 0; i < k_pass_size; ++i) pass.params.set(i, params);
        }
        const std::size_t count = std::min(k_pass_size, point_count - first);
        for (std::size_t n = 0; n < number_count; ++n) {
            float* const column = pass.params.column[numbers[n].column];
            for (std::size_t i = 0; i < count; ++i) column[i] = numbers[n].values[first + i];
            for (std::size_t i = count; i < k_pass_size; ++i) column[i] = column[count - 1];
        }
        if constexpr (k_is_prepared) {
            for (std::size_t i = 0; i < k_pass_size; ++i)
                pass.prepared.set(i, Preparation::run(pass.params[i]));
            return pass.prepared;
        } else {
            return pass.params;
        }
    }
};

/// The columns of `varying` in `Params`, whose members are the parameters.
template <class Params, std::size_t count>
std::vector<VaryingNumber> varying_numbers(const std::array<Field<Params>, count>& fields,
                                           std::span<const VaryingParameter> varying) {
    const Params params{};
    const auto* const begin = reinterpret_cast<const char*>(&params);
    std::vector<VaryingNumber> numbers;
    for (const VaryingParameter& one : varying) {
        const auto* const member = static_cast<const char*>(fields[one.parameter].member_of(params));
        numbers.push_back(
            {static_cast<std::size_t>(member - begin) / sizeof(float) + one.channel, one.values});
    }
    return numbers;
}

}  // namespace candela::sdk
