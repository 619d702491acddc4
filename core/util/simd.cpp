module;

#include "candela/kernel/simd_dispatch.h"

#if defined(__x86_64__)
// NOLINTNEXTLINE: before glibc 2.37 this header is C only
#define _Bool bool
#include <sys/platform/x86.h>
#undef _Bool
#endif

#include <atomic>
#include <optional>
#include <string_view>

module candela.util;

namespace candela {

namespace {

InstructionSet detect() noexcept {
#if defined(__x86_64__)
    // The levels of the x86-64 psABI. The C library queried the processor at start-up; querying it again
    // (__builtin_cpu_supports) takes a tenth of a millisecond in a virtual machine, because each query exits
    // to the host.
    const bool v3 = CPU_FEATURE_ACTIVE(AVX) && CPU_FEATURE_ACTIVE(AVX2) && CPU_FEATURE_ACTIVE(BMI1) &&
                    CPU_FEATURE_ACTIVE(BMI2) && CPU_FEATURE_ACTIVE(F16C) && CPU_FEATURE_ACTIVE(FMA) &&
                    CPU_FEATURE_ACTIVE(LZCNT) && CPU_FEATURE_ACTIVE(MOVBE);
    const bool v4 = v3 && CPU_FEATURE_ACTIVE(AVX512F) && CPU_FEATURE_ACTIVE(AVX512BW) &&
                    CPU_FEATURE_ACTIVE(AVX512CD) && CPU_FEATURE_ACTIVE(AVX512DQ) &&
                    CPU_FEATURE_ACTIVE(AVX512VL);
    if (v4) return InstructionSet::avx512;
    if (v3) return InstructionSet::avx2;
#endif
    return InstructionSet::baseline;
}

std::atomic<InstructionSet>& current() noexcept {
    static std::atomic<InstructionSet> set{detect()};
    return set;
}

}  // namespace

InstructionSet best_instruction_set() noexcept {
    static const InstructionSet best = detect();
    return best;
}

InstructionSet instruction_set() noexcept { return current().load(std::memory_order_relaxed); }

extern "C++" int instruction_set_level() noexcept { return static_cast<int>(instruction_set()); }

bool use_instruction_set(InstructionSet set) noexcept {
    if (set > best_instruction_set()) return false;
    current().store(set, std::memory_order_relaxed);
    return true;
}

std::string_view name_of(InstructionSet set) noexcept {
    switch (set) {
        case InstructionSet::avx512:
            return "avx512";
        case InstructionSet::avx2:
            return "avx2";
        case InstructionSet::baseline:
            break;
    }
    return "baseline";
}

std::optional<InstructionSet> instruction_set_named(std::string_view name) noexcept {
    for (const InstructionSet set : k_instruction_sets) {
        if (name_of(set) == name) return set;
    }
    return std::nullopt;
}

}  // namespace candela
