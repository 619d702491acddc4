// The instruction set of the batch loops, and code that several stages share. Every loop is compiled for each
// set; see candela/kernel/simd_dispatch.h.
module;

#include "candela/plugin/export.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

export module candela.util:simd;

export namespace candela {

/// From narrow to wide; a processor that supports one also supports all before it.
enum class InstructionSet : int { baseline = 0, avx2 = 1, avx512 = 2 };

inline constexpr InstructionSet k_instruction_sets[] = {InstructionSet::baseline, InstructionSet::avx2,
                                                        InstructionSet::avx512};

/// The widest set this processor supports.
CANDELA_EXPORT InstructionSet best_instruction_set() noexcept;

/// The set in use: the widest, unless use_instruction_set() chose another. Any thread.
CANDELA_EXPORT InstructionSet instruction_set() noexcept;

/// Chooses the set for all later batches of this process: for tests and measurements. Returns false and
/// changes nothing if the processor does not support it.
CANDELA_EXPORT bool use_instruction_set(InstructionSet set) noexcept;

/// "baseline", "avx2" or "avx512".
CANDELA_EXPORT std::string_view name_of(InstructionSet set) noexcept;
CANDELA_EXPORT std::optional<InstructionSet> instruction_set_named(std::string_view name) noexcept;

/// Whether all of these numbers are equal; true if there are none. Any thread.
CANDELA_EXPORT bool are_all_equal(std::span<const std::int32_t> numbers) noexcept;
CANDELA_EXPORT bool are_all_equal(std::span<const std::uint32_t> numbers) noexcept;

}  // namespace candela
