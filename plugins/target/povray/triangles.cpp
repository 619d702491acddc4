#include "triangles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace candela::povray_target {

namespace {

float largest(Vec3 v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

/// POV-Ray considers values equal that differ by at most 3e-5.
constexpr float k_equal = 1e-4f;

Vec3 turned(Vec3 n) {
    Vec3 other = n;
    float& smallest = std::abs(n.x) <= std::abs(n.y) && std::abs(n.x) <= std::abs(n.z) ? other.x
                      : std::abs(n.y) <= std::abs(n.z)                                 ? other.y
                                                                                       : other.z;
    smallest += k_equal;
    return normalized(other);
}

std::array<Vec3, 3> corners_of(const ExportedMesh& mesh, std::size_t first) {
    return {mesh.position[mesh.indices[first]], mesh.position[mesh.indices[first + 1]],
            mesh.position[mesh.indices[first + 2]]};
}

Vec3 face_normal(const Triangles& t, std::size_t first) {
    const Vec3 a = t.positions[t.indices[first]];
    return normalized(cross(t.positions[t.indices[first + 1]] - a, t.positions[t.indices[first + 2]] - a));
}

/// Towards the observer, of any length.
Vec3 to_observer(Vec3 from, const ExportedObserver& observer) {
    return observer.projection == Projection::perspective ? observer.position - from
                                                          : observer.position - observer.look_at;
}

bool is_on_outline(const Triangles& t, std::size_t first, bool is_front, const ExportedObserver& observer) {
    return std::ranges::any_of(std::array<std::size_t, 3>{0, 1, 2}, [&](std::size_t k) {
        const std::uint32_t vertex = t.indices[first + k];
        const float cosine = dot(t.normals[vertex], to_observer(t.positions[vertex], observer));
        return is_front ? cosine < 0 : cosine > 0;
    });
}

}  // namespace

Triangles triangles_of(const ExportedMesh& mesh, ConstVec3Span normal, bool is_textured,
                       VertexValues values) {
    Triangles result;
    result.values = std::move(values);
    for (std::size_t v = 0; v < mesh.vertex_count; ++v) {
        result.positions.push_back(mesh.position[v]);
        if (normal) result.normals.push_back(normal[v]);
        if (is_textured) result.uv.push_back({mesh.uv.x[v], mesh.uv.y[v]});
    }
    result.indices.assign(mesh.indices.begin(), mesh.indices.end());
    return result;
}

void keep_equal_normals(Triangles& t) {
    if (t.normals.empty()) return;
    for (std::size_t first = 0; first < t.indices.size(); first += 3) {
        const Vec3 a = t.normals[t.indices[first]];
        const bool are_equal = largest(a - t.normals[t.indices[first + 1]]) < k_equal &&
                               largest(a - t.normals[t.indices[first + 2]]) < k_equal;
        if (!are_equal || largest(face_normal(t, first) - a) < k_equal) continue;
        if (t.normal_indices.empty()) t.normal_indices = t.indices;
        t.normal_indices[first] = static_cast<std::uint32_t>(t.normals.size());
        t.normals.push_back(turned(a));
    }
}

Triangles split_off_outline(Triangles& t, const ExportedObserver& observer) {
    Triangles outline;
    std::vector<std::uint32_t> others;
    for (std::size_t first = 0; first < t.indices.size(); first += 3) {
        const Vec3 to_eye = to_observer(t.positions[t.indices[first]], observer);
        const bool is_front = dot(face_normal(t, first), to_eye) >= 0;
        if (!is_on_outline(t, first, is_front, observer)) {
            for (std::size_t k = 0; k < 3; ++k) others.push_back(t.indices[first + k]);
            continue;
        }
        for (const std::size_t k :
             {std::size_t{0}, is_front ? std::size_t{1} : 2, is_front ? std::size_t{2} : 1}) {
            const std::uint32_t vertex = t.indices[first + k];
            outline.indices.push_back(static_cast<std::uint32_t>(outline.positions.size()));
            outline.positions.push_back(t.positions[vertex]);
            outline.normals.push_back(is_front ? t.normals[vertex] : -t.normals[vertex]);
            if (!t.uv.empty()) outline.uv.push_back(t.uv[vertex]);
            if (!t.values.colors.empty()) outline.values.colors.push_back(t.values.colors[vertex]);
            if (!t.values.opacities.empty()) outline.values.opacities.push_back(t.values.opacities[vertex]);
        }
    }
    t.indices = std::move(others);
    return outline;
}

Triangles shell_of(const ExportedMesh& mesh) {
    constexpr float k_height = 3e-4f, k_relative = 1e-5f;  // metres, and relative to coordinates
    // Light that all but grazes a surface crosses the shell far from where it arrives.
    constexpr float k_overlap = 50;
    Triangles shell;
    for (std::size_t first = 0; first < mesh.indices.size(); first += 3) {
        const std::array<Vec3, 3> corners = corners_of(mesh, first);
        const Vec3 middle = 1.0f / 3 * (corners[0] + corners[1] + corners[2]);
        const Vec3 normal = normalized(cross(corners[1] - corners[0], corners[2] - corners[0]));
        for (const float side : {1.0f, -1.0f}) {
            if (side < 0 && mesh.is_solid) continue;
            for (const Vec3& corner : corners) {
                const float height = std::max(k_height, k_relative * largest(corner));
                shell.indices.push_back(static_cast<std::uint32_t>(shell.positions.size()));
                shell.positions.push_back(corner +
                                          height * (side * normal + k_overlap * normalized(corner - middle)));
            }
        }
    }
    return shell;
}

bool is_convex(const ExportedMesh& mesh) {
    constexpr std::size_t k_most = 20'000'000;  // comparisons
    constexpr float k_flat = 1e-5f;             // relative to coordinates
    if (mesh.triangle_count() * mesh.vertex_count > k_most) return false;
    for (std::size_t first = 0; first < mesh.indices.size(); first += 3) {
        const std::array<Vec3, 3> corners = corners_of(mesh, first);
        const Vec3 normal = normalized(cross(corners[1] - corners[0], corners[2] - corners[0]));
        for (std::size_t v = 0; v < mesh.vertex_count; ++v) {
            const float height = dot(normal, mesh.position[v] - corners[0]);
            const float limit = k_flat * std::max(largest(mesh.position[v]), largest(corners[0]));
            if (height > limit || (!mesh.is_solid && height < -limit)) return false;
        }
    }
    return true;
}

}  // namespace candela::povray_target
