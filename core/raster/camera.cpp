module;

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <span>

module candela.raster;

import candela.api;

namespace candela {

Camera Camera::looking(Vec3 eye, Vec3 look_at, Vec3 up, Projection projection, float size, int width,
                       int height) {
    const auto vector = [](Vec3 v) { return Eigen::Vector3d(v.x, v.y, v.z); };
    const auto plain = [](const Eigen::Vector3d& v) {
        const Eigen::Vector3f f = v.cast<float>();
        return Vec3{f.x(), f.y(), f.z()};
    };
    const Eigen::Vector3d forward = (vector(look_at) - vector(eye)).normalized();
    const Eigen::Vector3d right = forward.cross(vector(up)).normalized();
    const double half_height = 0.5 * height;
    const double scale =
        projection == Projection::perspective
            ? half_height / std::tan(0.5 * static_cast<double>(size) * std::numbers::pi / 180)
            : height / static_cast<double>(size);
    return {.eye = eye,
            .right = plain(right),
            .up = plain(right.cross(forward)),
            .forward = plain(forward),
            .projection = projection,
            .pixels_per_unit = static_cast<float>(scale),
            .width = width,
            .height = height};
}

Vec3 Camera::view_through(float x, float y) const {
    if (projection == Projection::orthographic) return forward;
    const float to_right = (x - 0.5f * static_cast<float>(width)) / pixels_per_unit;
    const float to_top = (0.5f * static_cast<float>(height) - y) / pixels_per_unit;
    return normalized(forward + to_right * right + to_top * up);
}

std::span<const SamplePosition> sample_pattern(int samples) noexcept {
    static constexpr SamplePosition k_one[] = {{8, 8}};
    static constexpr SamplePosition k_four[] = {{6, 2}, {14, 6}, {2, 10}, {10, 14}};
    static constexpr SamplePosition k_eight[] = {{9, 5},  {7, 11}, {13, 9},  {5, 3},
                                                 {3, 13}, {1, 7},  {11, 15}, {15, 1}};
    static constexpr SamplePosition k_sixteen[] = {{9, 9},   {7, 5},  {5, 10},  {12, 7}, {3, 6}, {10, 13},
                                                   {13, 11}, {11, 3}, {6, 14},  {8, 1},  {4, 2}, {2, 12},
                                                   {0, 8},   {15, 4}, {14, 15}, {1, 0}};
    switch (samples) {
        case 4:
            return k_four;
        case 8:
            return k_eight;
        case 16:
            return k_sixteen;
        default:
            return k_one;
    }
}

}  // namespace candela
