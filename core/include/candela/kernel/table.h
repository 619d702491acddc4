// Tables of the kernel language: the numbers of a ramp, a measurement or a file. table.glsl declares them for
// GLSL.
#pragma once

#include "candela/kernel/swizzles.h"

namespace candela::kernel {

inline constexpr float k_no_number = 0.0f;

/// Numbers that a member of the parameter struct refers to; the instance owns them. Kernels read them with
/// table_at(), table_size() and table_lookup(). Packed, so that such a struct has no padding between its
/// members.
struct [[gnu::packed, gnu::aligned(4)]] Table {
    const float* numbers = &k_no_number;
    int count = 0;
};

CANDELA_KERNEL_INLINE int table_size(Table t) { return t.count; }

/// Number i; past either end the first or the last one, and 0 in an empty table.
CANDELA_KERNEL_INLINE float table_at(Table t, int i) {
    const int last = t.count - 1;
    const int at = i < last ? i : last;
    return t.numbers[at > 0 ? at : 0];
}

}  // namespace candela::kernel
