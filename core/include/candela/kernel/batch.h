// Loads and stores of structure-of-arrays batches: element i of three arrays as a vector of the kernel
// language, for the bodies of batch loops. Works with anything whose members x, y and z can be indexed:
// Vec3Span, ConstVec3Span, arrays. Arrays have `count` elements, and nothing past the
// last one may be read, whatever `count` is: the renderer fills whole vectors, other callers do not.
#pragma once

#include "candela/kernel/kernel.h"

#include <cstddef>

namespace candela::kernel {

template <class Arrays>
CANDELA_KERNEL_INLINE vec3 load(const Arrays& from, std::size_t i) {
    return vec3(from.x[i], from.y[i], from.z[i]);
}

template <class Arrays>
CANDELA_KERNEL_INLINE void store(Arrays&& to, std::size_t i, vec3 v) {
    to.x[i] = v.x;
    to.y[i] = v.y;
    to.z[i] = v.z;
}

/// Adds a * b, channel by channel, each in one expression: where the processor supports it, product and sum
/// are rounded once.
template <class Arrays>
CANDELA_KERNEL_INLINE void add_product(Arrays&& to, std::size_t i, vec3 a, vec3 b) {
    to.x[i] += a.x * b.x;
    to.y[i] += a.y * b.y;
    to.z[i] += a.z * b.z;
}

}  // namespace candela::kernel
