module;

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <span>

module candela.geometry;

import :oriented_box;

namespace candela {

namespace {

using Vectors = Eigen::Matrix3Xd;

Eigen::Map<const Eigen::Vector3d> vector(const Double3& v) {
    return Eigen::Map<const Eigen::Vector3d>(v.data());
}

/// The axes as columns.
Eigen::Map<const Eigen::Matrix3d> matrix(const std::array<Double3, 3>& axes) {
    return Eigen::Map<const Eigen::Matrix3d>(axes.data()->data());
}

}  // namespace

OrientedBox oriented_box(std::span<const Double3> points) {
    const Eigen::Map<const Vectors> position(points.data()->data(), 3,
                                             static_cast<Eigen::Index>(points.size()));
    const Eigen::Vector3d mean = position.rowwise().mean();
    const Vectors centred = position.colwise() - mean;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(centred * centred.transpose());
    const Eigen::Matrix3d& axes = principal.eigenvectors();
    const Vectors along = axes.transpose() * centred;
    const Eigen::Vector3d low = along.rowwise().minCoeff(), high = along.rowwise().maxCoeff();
    OrientedBox box;
    Eigen::Map<Eigen::Vector3d>(box.centre.data()) = mean + axes * ((low + high) / 2);
    Eigen::Map<Eigen::Matrix3d>(box.axes.data()->data()) = axes;
    Eigen::Map<Eigen::Vector3d>(box.half.data()) = (high - low) / 2;
    return box;
}

bool may_meet(const OrientedBox& a, const OrientedBox& b, const Double3& shift) {
    const Eigen::Matrix3d turn = matrix(a.axes).transpose() * matrix(b.axes);
    const Eigen::Vector3d apart =
        matrix(a.axes).transpose() * (vector(b.centre) + vector(shift) - vector(a.centre));
    // The cross product of nearly parallel axes is mere rounding and must not separate anything.
    constexpr double k_rounding = 1e-9;
    const Eigen::Matrix3d reach = turn.cwiseAbs().array() + k_rounding;

    const Eigen::Vector3d along_a = vector(a.half) + reach * vector(b.half);
    if ((apart.cwiseAbs().array() > along_a.array()).any()) return false;
    const Eigen::Vector3d along_b = vector(b.half) + reach.transpose() * vector(a.half);
    if (((turn.transpose() * apart).cwiseAbs().array() > along_b.array()).any()) return false;
    for (int i = 0; i < 3; ++i) {
        const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
        for (int j = 0; j < 3; ++j) {
            const int j1 = (j + 1) % 3, j2 = (j + 2) % 3;
            const double of_a = vector(a.half)[i1] * reach(i2, j) + vector(a.half)[i2] * reach(i1, j);
            const double of_b = vector(b.half)[j1] * reach(i, j2) + vector(b.half)[j2] * reach(i, j1);
            if (std::abs(apart[i2] * turn(i1, j) - apart[i1] * turn(i2, j)) > of_a + of_b) return false;
        }
    }
    return true;
}

}  // namespace candela
