// The kernel language in C++: the part of GLSL that a <name>.kernel file may use.
//
// A kernel is in the common subset of C++ and GLSL: structs of float, int, vec2, vec3, vec4, mat3 and Table;
// functions marked KERNEL that take and return values; locals, ternaries, arithmetic; reading swizzles such
// as v.zyx; float literals written 0.5f; and the functions below, which have GLSL's names and meanings. Every
// function is inlined into the batch loop that calls it, and written so that the compiler can vectorise that
// loop: it has no branches, calls, errno or denormal results.
//
// Include kernels inside `namespace candela::kernel { ... }`, where the names resolve to these functions.
#pragma once

#include <cstdint>

#include "candela/kernel/vectors.h"

// A kernel function has its kind's arguments, whether or not the model uses them all.
#pragma GCC diagnostic ignored "-Wunused-parameter"

#define KERNEL [[gnu::always_inline, maybe_unused]] static inline

namespace candela::kernel {

// std::bit_cast() would do, but its header and <cmath> take longer to compile than the rest of a kernel, and
// users wait for kernels to compile.

CANDELA_KERNEL_INLINE constexpr std::int32_t float_bits_to_int(float x) {
    return __builtin_bit_cast(std::int32_t, x);
}
CANDELA_KERNEL_INLINE constexpr float int_bits_to_float(std::int32_t x) {
    return __builtin_bit_cast(float, x);
}

// Comparison and rounding.

CANDELA_KERNEL_INLINE constexpr float min(float a, float b) { return b < a ? b : a; }
CANDELA_KERNEL_INLINE constexpr float max(float a, float b) { return a < b ? b : a; }
CANDELA_KERNEL_INLINE constexpr int min(int a, int b) { return b < a ? b : a; }
CANDELA_KERNEL_INLINE constexpr int max(int a, int b) { return a < b ? b : a; }
CANDELA_KERNEL_INLINE constexpr float clamp(float x, float low, float high) { return min(max(x, low), high); }
CANDELA_KERNEL_INLINE constexpr float mix(float a, float b, float t) { return a * (1.0f - t) + b * t; }
CANDELA_KERNEL_INLINE constexpr float step(float edge, float x) { return x < edge ? 0.0f : 1.0f; }
CANDELA_KERNEL_INLINE constexpr float smoothstep(float edge0, float edge1, float x) {
    const float t = clamp((x - edge0) / (edge1 - edge0), 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
}
CANDELA_KERNEL_INLINE constexpr float sign(float x) { return x > 0.0f ? 1.0f : (x < 0.0f ? -1.0f : 0.0f); }
CANDELA_KERNEL_INLINE float abs(float x) { return __builtin_fabsf(x); }

/// Rounds to the nearest integer, halves to even, for |x| < 2^22. Adding and subtracting 1.5 * 2^23 needs no
/// SSE 4.1, so the baseline loop is vectorised as well.
CANDELA_KERNEL_INLINE float round_to_even(float x) { return (x + 12582912.0f) - 12582912.0f; }
/// For |x| < 2^22; larger floats have hardly any fraction.
CANDELA_KERNEL_INLINE float floor(float x) {
    const float nearest = round_to_even(x);
    const float rounded = nearest > x ? nearest - 1.0f : nearest;
    return abs(x) < 4194304.0f ? rounded : x;
}
CANDELA_KERNEL_INLINE float ceil(float x) { return -floor(-x); }
/// Towards zero.
CANDELA_KERNEL_INLINE float trunc(float x) { return x < 0.0f ? ceil(x) : floor(x); }
CANDELA_KERNEL_INLINE float fract(float x) { return x - floor(x); }
CANDELA_KERNEL_INLINE float mod(float x, float y) { return x - y * floor(x / y); }

// Powers: polynomials by Remez exchange, with their largest relative error in brackets.

CANDELA_KERNEL_INLINE float sqrt(float x) { return __builtin_sqrtf(x); }
/// For x > 0; returns a large number for zero [1.9e-8]. Takes an estimate from the bits (Blinn 1997,
/// "Floating-point tricks") and corrects it by a polynomial in the error of its square. This takes a fifth of
/// the time of a square root and a division, which a processor computes in one unit, element by element.
CANDELA_KERNEL_INLINE float inversesqrt(float x) {
    const float bounded = min(x, 3.4e38f);
    const auto guess = int_bits_to_float(0x5f330000 - (float_bits_to_int(bounded) >> 1));
    const float rest = 1.0f - bounded * guess * guess;
    float p = 0.32839867473f;
    p = p * rest + 0.309443295f;
    p = p * rest + 0.37501066923f;
    p = p * rest + 0.50000154972f;
    return guess + guess * rest * p;
}

/// 2^x, clamped to [2^-100, 2^127], because denormals would triple the frame time [9.3e-8].
CANDELA_KERNEL_INLINE float exp2(float x) {
    const float bounded = clamp(x, -100.0f, 127.0f);
    // Rounds like round_to_even(); the integer is in the last bits.
    const float shifted = bounded + 12582912.0f;
    const float f = bounded - (shifted - 12582912.0f);
    float p = 0.0013269535266f;
    p = p * f + 0.0096712922677f;
    p = p * f + 0.055507108569f;
    p = p * f + 0.24022246897f;
    p = p * f + 0.69314700365f;
    p = p * f + 1.0f;
    return int_bits_to_float(float_bits_to_int(p) + (float_bits_to_int(shifted) << 23));
}

/// Base-two logarithm of x; for anything smaller than 2^-126, that of 2^-126 [1.7e-7].
CANDELA_KERNEL_INLINE float log2(float x) {
    const auto bits = float_bits_to_int(max(x, 1.17549435e-38f));
    const std::int32_t exponent = (bits - 0x3f3504f3) >> 23;  // mantissa in [sqrt(1/2), sqrt(2))
    const float f = int_bits_to_float(bits - (exponent << 23)) - 1.0f;
    float p = -0.14581009726f;
    p = p * f + 0.23404164661f;
    p = p * f - 0.24887708166f;
    p = p * f + 0.28709880585f;
    p = p * f - 0.36023963289f;
    p = p * f + 0.48092323857f;
    p = p * f - 0.72135278806f;
    p = p * f + 1.442694962f;
    return static_cast<float>(exponent) + p * f;
}

CANDELA_KERNEL_INLINE float exp(float x) { return exp2(1.44269504f * x); }
CANDELA_KERNEL_INLINE float log(float x) { return 0.693147181f * log2(x); }
/// x^y for x >= 0; x^0 is 1.
CANDELA_KERNEL_INLINE float pow(float x, float y) { return exp2(y * log2(x)); }

// Angles, in radians.

CANDELA_KERNEL_INLINE constexpr float radians(float degrees) { return 0.0174532925f * degrees; }
CANDELA_KERNEL_INLINE constexpr float degrees(float radians) { return 57.2957795f * radians; }

/// The distance of x from the nearest multiple of pi, and whether that multiple is odd; for |x| up to a few
/// thousand.
struct ReducedAngle {
    float rest;
    float sign;
};
CANDELA_KERNEL_INLINE ReducedAngle reduce_by_pi(float x) {
    const float n = round_to_even(0.318309886f * x);
    const float rest = ((x - n * 3.140625f) - n * 9.67502593994e-4f) - n * 1.50995799e-7f;
    const float odd = n - 2.0f * round_to_even(0.5f * n);  // -1, 0 or 1
    return {rest, 1.0f - 2.0f * abs(odd)};
}
CANDELA_KERNEL_INLINE float sin(float x) {  // [4.3e-9]
    const ReducedAngle r = reduce_by_pi(x);
    const float z = r.rest * r.rest;
    float p = 2.6052249168e-6f;
    p = p * z - 0.00019809075306f;
    p = p * z + 0.008333051064f;
    p = p * z - 0.16666657992f;
    p = p * z + 1.0f;
    return r.sign * r.rest * p;
}
CANDELA_KERNEL_INLINE float cos(float x) {  // [2.4e-10]
    const ReducedAngle r = reduce_by_pi(x);
    const float z = r.rest * r.rest;
    float p = -2.607710459e-7f;
    p = p * z + 2.4761886226e-5f;
    p = p * z - 0.0013888403508f;
    p = p * z + 0.041666640728f;
    p = p * z - 0.4999999955f;
    return r.sign * (p * z + 1.0f);
}
CANDELA_KERNEL_INLINE float tan(float x) { return sin(x) / cos(x); }

/// asin of t in [0, 1/2] [8.1e-8].
CANDELA_KERNEL_INLINE float asin_of_small(float t) {
    const float z = t * t;
    float p = 0.050653528257f;
    p = p * z + 0.039647069538f;
    p = p * z + 0.075476364806f;
    p = p * z + 0.16665105905f;
    p = p * z + 1.0000000814f;
    return t * p;
}
/// Arguments outside [-1, 1] are clamped.
CANDELA_KERNEL_INLINE float acos(float x) {
    const float a = min(abs(x), 1.0f);
    const bool large = a > 0.5f;
    const float s = asin_of_small(large ? sqrt(0.5f * (1.0f - a)) : a);
    const float of_a = large ? 2.0f * s : 1.57079633f - s;
    return x < 0.0f ? 3.14159265f - of_a : of_a;
}
CANDELA_KERNEL_INLINE float asin(float x) {
    const float a = min(abs(x), 1.0f);
    const bool large = a > 0.5f;
    const float s = asin_of_small(large ? sqrt(0.5f * (1.0f - a)) : a);
    const float of_a = large ? 1.57079633f - 2.0f * s : s;
    return x < 0.0f ? -of_a : of_a;
}
CANDELA_KERNEL_INLINE float atan(float x) {  // [8.9e-8]
    const float a = abs(x);
    const bool large = a > 1.0f;
    const float t = large ? 1.0f / a : a;
    const float z = t * t;
    float p = -0.004780488272f;
    p = p * z + 0.024557242061f;
    p = p * z - 0.059904880312f;
    p = p * z + 0.099427705145f;
    p = p * z - 0.14029423813f;
    p = p * z + 0.19971375855f;
    p = p * z - 0.33332093564f;
    p = p * z + 0.99999991142f;
    const float of_a = large ? 1.57079633f - t * p : t * p;
    return x < 0.0f ? -of_a : of_a;
}
CANDELA_KERNEL_INLINE float atan(float y, float x) {
    const float of_quotient = atan(y / (x == 0.0f ? 1.0e-30f : x));
    return of_quotient + (x < 0.0f ? (y < 0.0f ? -3.14159265f : 3.14159265f) : 0.0f);
}

}  // namespace candela::kernel

#include "candela/kernel/functions.h"
#include "candela/kernel/table.h"

namespace candela::kernel {

// GLSL constructs structs with parentheses, which clang supports from version 16 on. For older versions, fill
// a struct of your own kernel member by member.
#if !defined(__cpp_aggregate_paren_init)
#define Reflected(...) \
    Reflected { __VA_ARGS__ }
#define Refracted(...) \
    Refracted { __VA_ARGS__ }
#define Incident(...) \
    Incident { __VA_ARGS__ }
#define Extent(...) \
    Extent { __VA_ARGS__ }
#endif

#include "candela/kernel/prelude.kernel"

}  // namespace candela::kernel
