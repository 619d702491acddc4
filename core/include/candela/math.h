// Plain vectors and structure-of-arrays views, which may cross a plugin's boundary.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace candela {

/// A point, direction or normal. Right-handed Cartesian space, y up; metres for points.
struct Vec3 {
    float x = 0;
    float y = 0;
    float z = 0;

    friend constexpr bool operator==(const Vec3&, const Vec3&) = default;
};

constexpr Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
constexpr Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
constexpr Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
constexpr Vec3 operator*(float s, Vec3 a) { return {s * a.x, s * a.y, s * a.z}; }
constexpr float dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vec3 cross(Vec3 a, Vec3 b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline float length(Vec3 a) { return std::sqrt(dot(a, a)); }

/// The unit vector along `a`, whatever its length; zero if `a` is zero or non-finite.
inline Vec3 normalized(Vec3 a) {
    const float size = length(a);
    if (size > 1e-15f && size < 1e15f) return (1 / size) * a;
    // The squares may have underflowed or overflowed.
    const double x = a.x, y = a.y, z = a.z;
    const double exact = std::sqrt(x * x + y * y + z * z);
    if (!(exact > 0) || !std::isfinite(exact)) return {};
    return {static_cast<float>(x / exact), static_cast<float>(y / exact), static_cast<float>(z / exact)};
}

/// A 3x3 matrix, row by row.
using Matrix = std::array<float, 9>;

/// Three read-only arrays of equal length. Non-owning; the batch that contains it knows the length.
struct ConstVec3Span {
    const float* x = nullptr;
    const float* y = nullptr;
    const float* z = nullptr;

    constexpr Vec3 operator[](std::size_t i) const { return {x[i], y[i], z[i]}; }
    constexpr ConstVec3Span from(std::size_t first) const { return {x + first, y + first, z + first}; }
    constexpr explicit operator bool() const { return x != nullptr; }
};

/// Three writable arrays of equal length. Non-owning; the batch that contains it knows the length.
struct Vec3Span {
    float* x = nullptr;
    float* y = nullptr;
    float* z = nullptr;

    constexpr Vec3 operator[](std::size_t i) const { return {x[i], y[i], z[i]}; }
    constexpr void set(std::size_t i, Vec3 v) const {
        x[i] = v.x;
        y[i] = v.y;
        z[i] = v.z;
    }
    constexpr Vec3Span from(std::size_t first) const { return {x + first, y + first, z + first}; }
    constexpr explicit operator bool() const { return x != nullptr; }
    constexpr operator ConstVec3Span() const { return {x, y, z}; }
};

/// Two arrays of equal length: texture coordinates.
struct ConstVec2Span {
    const float* x = nullptr;
    const float* y = nullptr;

    constexpr ConstVec2Span from(std::size_t first) const { return {x + first, y + first}; }
    constexpr explicit operator bool() const { return x != nullptr; }
};

struct Vec2Span {
    float* x = nullptr;
    float* y = nullptr;

    constexpr Vec2Span from(std::size_t first) const { return {x + first, y + first}; }
    constexpr explicit operator bool() const { return x != nullptr; }
    constexpr operator ConstVec2Span() const { return {x, y}; }
};

}  // namespace candela
