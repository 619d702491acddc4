// Reading swizzles of the kernel language, v.xy and v.zyx, as in GLSL: empty members of a vector, one for
// each two, three or four of its components, which convert to the vector of those components. They take no
// space and, once inlined, no time.
#pragma once

#define CANDELA_KERNEL_INLINE [[gnu::always_inline]] inline

namespace candela::kernel {

struct vec2;
struct vec3;
struct vec4;

/// A member of `Whole`, at the same address. It is read-only: GLSL also allows assignment, C++ rejects it.
template <class Whole, class Part, float Whole::*... components>
struct Swizzle {
    Swizzle() = default;
    Swizzle(const Swizzle&) = delete;
    Swizzle& operator=(const Swizzle&) = delete;
    ~Swizzle() = default;

    // Kernels are GLSL, which has no explicit conversion here.
    // NOLINTNEXTLINE(google-explicit-constructor,hicpp-explicit-conversions)
    CANDELA_KERNEL_INLINE operator Part() const {
        const auto* const whole = reinterpret_cast<const Whole*>(this);
        return Part(whole->*components...);
    }
};

}  // namespace candela::kernel

// CANDELA_SWIZZLES_OF_2(V), _3 and _4 declare the swizzles of a vector V. A macro cannot call itself, hence
// one macro per position and number of components.
#define CANDELA_SWIZZLE_2(V, a, b) [[no_unique_address]] Swizzle<V, vec2, &V::a, &V::b> a##b;
#define CANDELA_SWIZZLE_3(V, a, b, c) [[no_unique_address]] Swizzle<V, vec3, &V::a, &V::b, &V::c> a##b##c;
#define CANDELA_SWIZZLE_4(V, a, b, c, d) \
    [[no_unique_address]] Swizzle<V, vec4, &V::a, &V::b, &V::c, &V::d> a##b##c##d;

#define CANDELA_ANY_FOURTH_OF_2(V, ...) \
    CANDELA_SWIZZLE_4(V, __VA_ARGS__, x) CANDELA_SWIZZLE_4(V, __VA_ARGS__, y)
#define CANDELA_ANY_FOURTH_OF_3(V, ...) \
    CANDELA_ANY_FOURTH_OF_2(V, __VA_ARGS__) CANDELA_SWIZZLE_4(V, __VA_ARGS__, z)
#define CANDELA_ANY_FOURTH_OF_4(V, ...) \
    CANDELA_ANY_FOURTH_OF_3(V, __VA_ARGS__) CANDELA_SWIZZLE_4(V, __VA_ARGS__, w)

#define CANDELA_THIRD(size, V, ...) \
    CANDELA_SWIZZLE_3(V, __VA_ARGS__) CANDELA_ANY_FOURTH_OF_##size(V, __VA_ARGS__)
#define CANDELA_ANY_THIRD_OF_2(size, V, ...) \
    CANDELA_THIRD(size, V, __VA_ARGS__, x) CANDELA_THIRD(size, V, __VA_ARGS__, y)
#define CANDELA_ANY_THIRD_OF_3(size, V, ...) \
    CANDELA_ANY_THIRD_OF_2(size, V, __VA_ARGS__) CANDELA_THIRD(size, V, __VA_ARGS__, z)
#define CANDELA_ANY_THIRD_OF_4(size, V, ...) \
    CANDELA_ANY_THIRD_OF_3(size, V, __VA_ARGS__) CANDELA_THIRD(size, V, __VA_ARGS__, w)

#define CANDELA_SECOND(size, V, ...) \
    CANDELA_SWIZZLE_2(V, __VA_ARGS__) CANDELA_ANY_THIRD_OF_##size(size, V, __VA_ARGS__)
#define CANDELA_ANY_SECOND_OF_2(size, V, a) CANDELA_SECOND(size, V, a, x) CANDELA_SECOND(size, V, a, y)
#define CANDELA_ANY_SECOND_OF_3(size, V, a) CANDELA_ANY_SECOND_OF_2(size, V, a) CANDELA_SECOND(size, V, a, z)
#define CANDELA_ANY_SECOND_OF_4(size, V, a) CANDELA_ANY_SECOND_OF_3(size, V, a) CANDELA_SECOND(size, V, a, w)

#define CANDELA_SWIZZLES_OF_2(V) CANDELA_ANY_SECOND_OF_2(2, V, x) CANDELA_ANY_SECOND_OF_2(2, V, y)
#define CANDELA_SWIZZLES_OF_3(V)     \
    CANDELA_ANY_SECOND_OF_3(3, V, x) \
    CANDELA_ANY_SECOND_OF_3(3, V, y) CANDELA_ANY_SECOND_OF_3(3, V, z)
#define CANDELA_SWIZZLES_OF_4(V)     \
    CANDELA_ANY_SECOND_OF_4(4, V, x) \
    CANDELA_ANY_SECOND_OF_4(4, V, y) CANDELA_ANY_SECOND_OF_4(4, V, z) CANDELA_ANY_SECOND_OF_4(4, V, w)
