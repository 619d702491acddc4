module;

#include "candela/multiversion.h"

#include <atomic>
#include <optional>
#include <string_view>

module candela.simd;

namespace candela {

namespace {

InstructionSet detect() noexcept {
#if defined(__x86_64__)
    __builtin_cpu_init();
    if (__builtin_cpu_supports("x86-64-v4")) return InstructionSet::avx512;
    if (__builtin_cpu_supports("x86-64-v3")) return InstructionSet::avx2;
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
