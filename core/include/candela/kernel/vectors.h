// The vectors and matrices of the kernel language, with GLSL's operators.
#pragma once

#include "candela/kernel/swizzles.h"

namespace candela::kernel {

// Copies are spelled out because an implicit copy is a memcpy, which keeps `condition ? a : b` from becoming
// a vector blend.

struct vec2 {
    float x, y;
    CANDELA_SWIZZLES_OF_2(vec2)

    vec2() = default;
    CANDELA_KERNEL_INLINE constexpr explicit vec2(float s) : x(s), y(s) {}
    CANDELA_KERNEL_INLINE constexpr vec2(float in_x, float in_y) : x(in_x), y(in_y) {}
    // NOLINTNEXTLINE(modernize-use-equals-default)
    CANDELA_KERNEL_INLINE constexpr vec2(const vec2& v) : x(v.x), y(v.y) {}
    // NOLINTNEXTLINE(modernize-use-equals-default)
    CANDELA_KERNEL_INLINE constexpr vec2& operator=(const vec2& v) {
        x = v.x;
        y = v.y;
        return *this;
    }
};

struct vec3 {
    float x, y, z;
    CANDELA_SWIZZLES_OF_3(vec3)

    vec3() = default;
    CANDELA_KERNEL_INLINE constexpr explicit vec3(float s) : x(s), y(s), z(s) {}
    CANDELA_KERNEL_INLINE constexpr vec3(float in_x, float in_y, float in_z) : x(in_x), y(in_y), z(in_z) {}
    CANDELA_KERNEL_INLINE constexpr vec3(vec2 v, float in_z) : x(v.x), y(v.y), z(in_z) {}
    CANDELA_KERNEL_INLINE constexpr vec3(float in_x, vec2 v) : x(in_x), y(v.x), z(v.y) {}
    // NOLINTNEXTLINE(modernize-use-equals-default)
    CANDELA_KERNEL_INLINE constexpr vec3(const vec3& v) : x(v.x), y(v.y), z(v.z) {}
    // NOLINTNEXTLINE(modernize-use-equals-default)
    CANDELA_KERNEL_INLINE constexpr vec3& operator=(const vec3& v) {
        x = v.x;
        y = v.y;
        z = v.z;
        return *this;
    }
};

struct vec4 {
    float x, y, z, w;
    CANDELA_SWIZZLES_OF_4(vec4)

    vec4() = default;
    CANDELA_KERNEL_INLINE constexpr explicit vec4(float s) : x(s), y(s), z(s), w(s) {}
    CANDELA_KERNEL_INLINE constexpr vec4(float in_x, float in_y, float in_z, float in_w)
        : x(in_x), y(in_y), z(in_z), w(in_w) {}
    CANDELA_KERNEL_INLINE constexpr vec4(vec3 v, float in_w) : x(v.x), y(v.y), z(v.z), w(in_w) {}
    CANDELA_KERNEL_INLINE constexpr vec4(float in_x, vec3 v) : x(in_x), y(v.x), z(v.y), w(v.z) {}
    CANDELA_KERNEL_INLINE constexpr vec4(vec2 a, vec2 b) : x(a.x), y(a.y), z(b.x), w(b.y) {}
    // NOLINTNEXTLINE(modernize-use-equals-default)
    CANDELA_KERNEL_INLINE constexpr vec4(const vec4& v) : x(v.x), y(v.y), z(v.z), w(v.w) {}
    // NOLINTNEXTLINE(modernize-use-equals-default)
    CANDELA_KERNEL_INLINE constexpr vec4& operator=(const vec4& v) {
        x = v.x;
        y = v.y;
        z = v.z;
        w = v.w;
        return *this;
    }
};

#define CANDELA_VECTOR_OPERATOR(V, op, both, left, right)                                \
    CANDELA_KERNEL_INLINE constexpr V operator op(V a, V b) { return V both; }           \
    CANDELA_KERNEL_INLINE constexpr V operator op(V a, float s) { return V left; }       \
    CANDELA_KERNEL_INLINE constexpr V operator op(float s, V a) { return V right; }      \
    CANDELA_KERNEL_INLINE constexpr V& operator op##=(V & a, V b) { return a = a op b; } \
    CANDELA_KERNEL_INLINE constexpr V& operator op##=(V & a, float s) { return a = a op s; }
#define CANDELA_VECTOR_OPERATORS(op)                                                                        \
    CANDELA_VECTOR_OPERATOR(vec2, op, (a.x op b.x, a.y op b.y), (a.x op s, a.y op s), (s op a.x, s op a.y)) \
    CANDELA_VECTOR_OPERATOR(vec3, op, (a.x op b.x, a.y op b.y, a.z op b.z), (a.x op s, a.y op s, a.z op s), \
                            (s op a.x, s op a.y, s op a.z))                                                 \
    CANDELA_VECTOR_OPERATOR(vec4, op, (a.x op b.x, a.y op b.y, a.z op b.z, a.w op b.w),                     \
                            (a.x op s, a.y op s, a.z op s, a.w op s),                                       \
                            (s op a.x, s op a.y, s op a.z, s op a.w))
CANDELA_VECTOR_OPERATORS(+)
CANDELA_VECTOR_OPERATORS(-)
CANDELA_VECTOR_OPERATORS(*)
CANDELA_VECTOR_OPERATORS(/)
#undef CANDELA_VECTOR_OPERATORS
#undef CANDELA_VECTOR_OPERATOR
CANDELA_KERNEL_INLINE constexpr vec2 operator-(vec2 a) { return vec2(-a.x, -a.y); }
CANDELA_KERNEL_INLINE constexpr vec3 operator-(vec3 a) { return vec3(-a.x, -a.y, -a.z); }
CANDELA_KERNEL_INLINE constexpr vec4 operator-(vec4 a) { return vec4(-a.x, -a.y, -a.z, -a.w); }

/// Three columns.
struct mat3 {
    vec3 first, second, third;

    mat3() = default;
    /// `diagonal` times the identity.
    CANDELA_KERNEL_INLINE constexpr explicit mat3(float diagonal)
        : first(diagonal, 0.0f, 0.0f), second(0.0f, diagonal, 0.0f), third(0.0f, 0.0f, diagonal) {}
    CANDELA_KERNEL_INLINE constexpr mat3(vec3 a, vec3 b, vec3 c) : first(a), second(b), third(c) {}
    // NOLINTNEXTLINE(modernize-use-equals-default)
    CANDELA_KERNEL_INLINE constexpr mat3(const mat3& m) : first(m.first), second(m.second), third(m.third) {}
    // NOLINTNEXTLINE(modernize-use-equals-default)
    CANDELA_KERNEL_INLINE constexpr mat3& operator=(const mat3& m) {
        first = m.first;
        second = m.second;
        third = m.third;
        return *this;
    }

    /// A column, read-only.
    CANDELA_KERNEL_INLINE constexpr vec3 operator[](int i) const {
        return i == 0 ? first : (i == 1 ? second : third);
    }
};

CANDELA_KERNEL_INLINE constexpr float dot(vec2 a, vec2 b) { return a.x * b.x + a.y * b.y; }
CANDELA_KERNEL_INLINE constexpr float dot(vec3 a, vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
CANDELA_KERNEL_INLINE constexpr float dot(vec4 a, vec4 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w;
}
CANDELA_KERNEL_INLINE constexpr vec3 cross(vec3 a, vec3 b) {
    return vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

CANDELA_KERNEL_INLINE constexpr mat3 operator+(mat3 a, mat3 b) {
    return mat3(a.first + b.first, a.second + b.second, a.third + b.third);
}
CANDELA_KERNEL_INLINE constexpr mat3 operator-(mat3 a, mat3 b) {
    return mat3(a.first - b.first, a.second - b.second, a.third - b.third);
}
CANDELA_KERNEL_INLINE constexpr mat3 operator*(mat3 m, float s) {
    return mat3(m.first * s, m.second * s, m.third * s);
}
CANDELA_KERNEL_INLINE constexpr mat3 operator*(float s, mat3 m) { return m * s; }
CANDELA_KERNEL_INLINE constexpr vec3 operator*(mat3 m, vec3 v) {
    return m.first * v.x + m.second * v.y + m.third * v.z;
}
CANDELA_KERNEL_INLINE constexpr vec3 operator*(vec3 v, mat3 m) {
    return vec3(dot(v, m.first), dot(v, m.second), dot(v, m.third));
}
CANDELA_KERNEL_INLINE constexpr mat3 operator*(mat3 a, mat3 b) {
    return mat3(a * b.first, a * b.second, a * b.third);
}
CANDELA_KERNEL_INLINE constexpr mat3 transpose(mat3 m) {
    return mat3(vec3(m.first.x, m.second.x, m.third.x), vec3(m.first.y, m.second.y, m.third.y),
                vec3(m.first.z, m.second.z, m.third.z));
}
CANDELA_KERNEL_INLINE constexpr float determinant(mat3 m) { return dot(m.first, cross(m.second, m.third)); }
/// The inverse of a matrix whose determinant is not zero.
CANDELA_KERNEL_INLINE constexpr mat3 inverse(mat3 m) {
    return (1.0f / determinant(m)) *
           transpose(mat3(cross(m.second, m.third), cross(m.third, m.first), cross(m.first, m.second)));
}

}  // namespace candela::kernel
