// The vector functions of the kernel language: the scalar functions component by component, and geometry.
// Included by kernel.h, which has the scalar functions.
#pragma once

#include "candela/kernel/vectors.h"

namespace candela::kernel {

// f(v), f(v, w), f(v, w, u) of vectors of one size.
#define CANDELA_OF_ONE(f)                                                         \
    CANDELA_KERNEL_INLINE vec2 f(vec2 a) { return vec2(f(a.x), f(a.y)); }         \
    CANDELA_KERNEL_INLINE vec3 f(vec3 a) { return vec3(f(a.x), f(a.y), f(a.z)); } \
    CANDELA_KERNEL_INLINE vec4 f(vec4 a) { return vec4(f(a.x), f(a.y), f(a.z), f(a.w)); }
#define CANDELA_OF_TWO(f)                                                                                \
    CANDELA_KERNEL_INLINE vec2 f(vec2 a, vec2 b) { return vec2(f(a.x, b.x), f(a.y, b.y)); }              \
    CANDELA_KERNEL_INLINE vec3 f(vec3 a, vec3 b) { return vec3(f(a.x, b.x), f(a.y, b.y), f(a.z, b.z)); } \
    CANDELA_KERNEL_INLINE vec4 f(vec4 a, vec4 b) {                                                       \
        return vec4(f(a.x, b.x), f(a.y, b.y), f(a.z, b.z), f(a.w, b.w));                                 \
    }
#define CANDELA_OF_THREE(f)                                                                  \
    CANDELA_KERNEL_INLINE vec2 f(vec2 a, vec2 b, vec2 c) {                                   \
        return vec2(f(a.x, b.x, c.x), f(a.y, b.y, c.y));                                     \
    }                                                                                        \
    CANDELA_KERNEL_INLINE vec3 f(vec3 a, vec3 b, vec3 c) {                                   \
        return vec3(f(a.x, b.x, c.x), f(a.y, b.y, c.y), f(a.z, b.z, c.z));                   \
    }                                                                                        \
    CANDELA_KERNEL_INLINE vec4 f(vec4 a, vec4 b, vec4 c) {                                   \
        return vec4(f(a.x, b.x, c.x), f(a.y, b.y, c.y), f(a.z, b.z, c.z), f(a.w, b.w, c.w)); \
    }

CANDELA_OF_ONE(abs)
CANDELA_OF_ONE(sign)
CANDELA_OF_ONE(floor)
CANDELA_OF_ONE(trunc)
CANDELA_OF_ONE(ceil)
CANDELA_OF_ONE(fract)
CANDELA_OF_ONE(sqrt)
CANDELA_OF_ONE(inversesqrt)
CANDELA_OF_ONE(exp)
CANDELA_OF_ONE(exp2)
CANDELA_OF_ONE(log)
CANDELA_OF_ONE(log2)
CANDELA_OF_ONE(radians)
CANDELA_OF_ONE(degrees)
CANDELA_OF_ONE(sin)
CANDELA_OF_ONE(cos)
CANDELA_OF_ONE(tan)
CANDELA_OF_ONE(asin)
CANDELA_OF_ONE(acos)
CANDELA_OF_ONE(atan)
CANDELA_OF_TWO(atan)
CANDELA_OF_TWO(pow)
CANDELA_OF_TWO(mod)
CANDELA_OF_TWO(min)
CANDELA_OF_TWO(max)
CANDELA_OF_TWO(step)
CANDELA_OF_THREE(clamp)
CANDELA_OF_THREE(mix)
CANDELA_OF_THREE(smoothstep)
#undef CANDELA_OF_ONE
#undef CANDELA_OF_TWO
#undef CANDELA_OF_THREE

// GLSL also accepts a number for all components here.
#define CANDELA_WITH_NUMBERS(V)                                                                     \
    CANDELA_KERNEL_INLINE V mod(V a, float b) { return mod(a, V(b)); }                              \
    CANDELA_KERNEL_INLINE V min(V a, float b) { return min(a, V(b)); }                              \
    CANDELA_KERNEL_INLINE V max(V a, float b) { return max(a, V(b)); }                              \
    CANDELA_KERNEL_INLINE V step(float edge, V a) { return step(V(edge), a); }                      \
    CANDELA_KERNEL_INLINE V clamp(V a, float low, float high) { return clamp(a, V(low), V(high)); } \
    CANDELA_KERNEL_INLINE V mix(V a, V b, float t) { return mix(a, b, V(t)); }                      \
    CANDELA_KERNEL_INLINE V smoothstep(float edge0, float edge1, V a) {                             \
        return smoothstep(V(edge0), V(edge1), a);                                                   \
    }
CANDELA_WITH_NUMBERS(vec2)
CANDELA_WITH_NUMBERS(vec3)
CANDELA_WITH_NUMBERS(vec4)
#undef CANDELA_WITH_NUMBERS

#define CANDELA_GEOMETRY(V)                                                                      \
    CANDELA_KERNEL_INLINE float length(V a) { return sqrt(dot(a, a)); }                          \
    CANDELA_KERNEL_INLINE float distance(V a, V b) { return length(a - b); }                     \
    /** The unit vector along `a`. GLSL leaves the zero vector undefined; here it stays zero. */ \
    CANDELA_KERNEL_INLINE V normalize(V a) { return a * inversesqrt(max(dot(a, a), 1.0e-36f)); } \
    CANDELA_KERNEL_INLINE constexpr V reflect(V incident, V normal) {                            \
        return incident - 2.0f * dot(normal, incident) * normal;                                 \
    }
CANDELA_GEOMETRY(vec2)
CANDELA_GEOMETRY(vec3)
CANDELA_GEOMETRY(vec4)
#undef CANDELA_GEOMETRY

/// Snell's law; zero beyond the critical angle. `eta`: n_1 / n_2; `normal` points to the side the light comes
/// from.
CANDELA_KERNEL_INLINE vec3 refract(vec3 incident, vec3 normal, float eta) {
    const float cosine = dot(normal, incident);
    const float k = 1.0f - eta * eta * (1.0f - cosine * cosine);
    const vec3 refracted = eta * incident - (eta * cosine + sqrt(max(k, 0.0f))) * normal;
    return k < 0.0f ? vec3(0.0f) : refracted;
}

}  // namespace candela::kernel
