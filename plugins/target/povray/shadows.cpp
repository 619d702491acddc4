#include "shadows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string>

#include "triangles.h"

namespace candela::povray_target {

namespace {

/// POV-Ray's SHADOW_TOLERANCE: what is nearer to a surface does not block its light. Metres.
constexpr double k_tolerance = 1e-3;

/// The size of a pixel at the place that the observer looks at.
double pixel_size(const ExportedScene& scene) {
    const ExportedObserver& observer = scene.observer;
    const double height = observer.projection == Projection::perspective
                              ? 2 * std::tan(observer.fov * std::numbers::pi / 360) *
                                    length(observer.look_at - observer.position)
                              : observer.height;
    return height / scene.image.height;
}

bool has_extent(const ExportedLight& light) {
    return std::ranges::any_of(light.punctual, [](const PunctualLight& sample) {
        return sample.extent_u != Vec3{} || sample.extent_v != Vec3{};
    });
}

/// Whether normals are visibly not those of the faces, so that a surface may face a light that its triangle
/// does not face.
bool has_smooth_normals(const ExportedMesh& mesh, ConstVec3Span normal) {
    constexpr float k_equal = 1e-4f;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const Vec3 a = mesh.position[mesh.indices[i]];
        const Vec3 face =
            normalized(cross(mesh.position[mesh.indices[i + 1]] - a, mesh.position[mesh.indices[i + 2]] - a));
        for (std::size_t k = 0; k < 3; ++k) {
            if (length(normal[mesh.indices[i + k]] - face) > k_equal) return true;
        }
    }
    return false;
}

/// Whether normals lean towards each other along an edge: the surface that the triangles stand for rises
/// there towards a light that its triangles do not face.
bool is_hollow(const ExportedMesh& mesh, ConstVec3Span normal) {
    constexpr float k_bend = 1e-3f;
    for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
        const std::uint32_t from = mesh.indices[i], to = mesh.indices[i % 3 == 2 ? i - 2 : i + 1];
        const Vec3 edge = mesh.position[to] - mesh.position[from];
        if (dot(normal[to] - normal[from], edge) < -k_bend * length(edge)) return true;
    }
    return false;
}

}  // namespace

bool has_unblocked_lights(const ExportedScene& scene, const ExportedObject& object) {
    return std::ranges::any_of(scene.lights, [&](const ExportedLight& light) {
        return !light.punctual.empty() && (!light.casts_shadows || !object.receives_shadows);
    });
}

void approximate_shadows(const ExportedScene& scene, FileSink& files) {
    const auto say = [&](const ExportedLight& light, const char* what) {
        files.approximate(fmt::format("light {} {}", light.label, what).c_str());
    };
    for (const ExportedLight& light : scene.lights) {
        if (light.ambient_occlusion_rays > 0)
            say(light, "is not darkened by what is near: it has no ambient occlusion");
        if (!light.is_data) continue;  // left out
        if (light.casts_shadows && scene.shadows_vary && has_extent(light))
            say(light, "has as many steps in its penumbras as it has samples");
    }
    if (pixel_size(scene) < k_tolerance)
        files.approximate("objects that are nearer than a millimetre to a surface cast no shadow on it");
}

void approximate_shadows(const ExportedScene& scene, std::size_t index, const ExportedMesh& mesh,
                         FileSink& files) {
    const ExportedObject& object = scene.objects[index];
    const auto say = [&](const char* what) {
        files.approximate(fmt::format("object {} {}", object.label, what).c_str());
    };
    if (has_unblocked_lights(scene, object) && !is_convex(mesh))
        say("is not convex, so that unblocked light is blocked between its parts");
    if (!object.casts_shadows || !object.receives_shadows ||
        scene.shadings[object.shading].rate == ShadingRate::face)
        return;
    const ConstVec3Span normal = mesh.normals[mesh.normals_of[object.shading]];
    if (!mesh.is_solid && has_smooth_normals(mesh, normal))
        say("is open, and its own shadow begins where its triangles turn away from a light, not its normals");
    if (mesh.is_solid && is_hollow(mesh, normal))
        say("is hollow in places, where its own shadow begins where its normals turn away from a light, "
            "not its triangles");
}

}  // namespace candela::povray_target
