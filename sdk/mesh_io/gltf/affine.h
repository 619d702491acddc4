// Transformations of a glTF file's nodes.
#pragma once

#include <array>
#include <cstddef>

namespace mesh_io::gltf {

/// The upper three rows of a transformation; columns.
struct Affine {
    std::array<std::array<double, 3>, 4> column = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}}};

    std::array<double, 3> linear(std::array<double, 3> v) const {
        std::array<double, 3> r{};
        for (std::size_t row = 0; row < 3; ++row)
            for (std::size_t c = 0; c < 3; ++c) r[row] += column[c][row] * v[c];
        return r;
    }
    std::array<double, 3> point(std::array<double, 3> v) const {
        std::array<double, 3> r = linear(v);
        for (std::size_t row = 0; row < 3; ++row) r[row] += column[3][row];
        return r;
    }
    /// Normals are transformed by its cofactors: the inverse transpose, up to a factor.
    Affine cofactors() const {
        Affine r;
        for (std::size_t c = 0; c < 3; ++c) {
            const auto &a = column[(c + 1) % 3], &b = column[(c + 2) % 3];
            r.column[c] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
        }
        return r;
    }
    double determinant() const {
        const auto n = cofactors().column[0];
        return n[0] * column[0][0] + n[1] * column[0][1] + n[2] * column[0][2];
    }
};

inline Affine operator*(const Affine& a, const Affine& b) {
    Affine r;
    for (std::size_t c = 0; c < 3; ++c) r.column[c] = a.linear(b.column[c]);
    r.column[3] = a.point(b.column[3]);
    return r;
}

/// A rotation as stored in glTF, x y z w.
inline Affine rotation_of(const std::array<double, 4>& q) {
    const auto [x, y, z, w] = q;
    Affine r;
    r.column[0] = {1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)};
    r.column[1] = {2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)};
    r.column[2] = {2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)};
    return r;
}

/// Scales, then rotates, then translates.
inline Affine affine_of(const std::array<double, 3>& translation, const std::array<double, 4>& rotation,
                        const std::array<double, 3>& scale) {
    Affine r = rotation_of(rotation);
    for (std::size_t c = 0; c < 3; ++c)
        for (double& v : r.column[c]) v *= scale[c];
    r.column[3] = translation;
    return r;
}

}  // namespace mesh_io::gltf
