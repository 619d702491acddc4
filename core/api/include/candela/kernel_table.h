// Tables of the kernel language: the numbers of a ramp, a measurement, a file. In GLSL they are what
// table.glsl declares.
#pragma once

#include "candela/swizzles.h"

namespace candela::kernel {

inline constexpr float k_no_number = 0.0f;

/// Numbers that a member of the parameters' struct refers to. Kernels read them with table_at(), table_size()
/// and table_lookup(). Packed, so that nothing lies between the members of such a struct. The numbers are the
/// instance's.
struct [[gnu::packed, gnu::aligned(4)]] Table {
    const float* numbers = &k_no_number;
    int count = 0;
};

CANDELA_KERNEL_INLINE int table_size(Table t) { return t.count; }

/// Number i; the first or the last beyond the ends, 0 where there are none.
CANDELA_KERNEL_INLINE float table_at(Table t, int i) {
    const int last = t.count - 1;
    const int at = i < last ? i : last;
    return t.numbers[at > 0 ? at : 0];
}

}  // namespace candela::kernel
