// Meshes that the shape `mesh` reads, for its tests.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "support/command.h"
#include "support/plugins.h"
#include "support/samples.h"

inline candela::Mesh mesh_of(const std::filesystem::path& file, double crease_angle = 40,
                             const char* shading = "phong") {
    return candela::build_mesh(
        *instance<candela::Shape>("mesh", {{"file", file.string()}, {"crease_angle", crease_angle}}), {}, {},
        *instance<candela::ShadingModel>(shading));
}

inline candela::Mesh mesh_of_text(const char* name, const std::string& text, double crease_angle = 40,
                                  const char* shading = "phong") {
    return mesh_of(write_file(scratch_directory() / name, text), crease_angle, shading);
}

inline std::vector<std::string> warnings_about(const char* name, const std::string& text) {
    const auto file = write_file(scratch_directory() / name, text);
    return candela::place(*instance<candela::Shape>("mesh", {{"file", file.string()}}), {}, {}).warnings;
}

inline candela::Vec3 normal_of_corner(const candela::Mesh& mesh, std::size_t corner) {
    return mesh.vertices[mesh.indices[corner]].normal;
}

/// Whether all corners have the normals of their faces.
inline bool has_hard_edge(const candela::Mesh& mesh) {
    for (std::size_t corner = 0; corner < mesh.indices.size(); ++corner)
        if (!agree(normal_of_corner(mesh, corner), mesh.face_normal.span()[corner / 3], 1e-6)) return false;
    return true;
}
