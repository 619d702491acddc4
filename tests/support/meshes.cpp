#include "support/meshes.h"

#include <cstddef>
#include <cstdint>

candela::Mesh flat_mesh(const char* shape, Given given, const candela::Transform& transform) {
    return candela::build_mesh(*instance<candela::Shape>(shape, given), {}, transform,
                               *instance<candela::ShadingModel>("flat"));
}

candela::Mesh loose_triangles(std::span<const candela::Vec3> corners, const candela::Box& bounds) {
    candela::Mesh mesh;
    mesh.bounds = bounds;
    mesh.position.resize(corners.size());
    for (std::size_t i = 0; i < corners.size(); ++i) {
        mesh.position.span().set(i, corners[i]);
        mesh.indices.push_back(static_cast<std::uint32_t>(i));
        mesh.vertices.push_back({.position = corners[i], .normal = {}});
    }
    return mesh;
}
