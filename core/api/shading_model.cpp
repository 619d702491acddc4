#include "candela/shading_model.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace candela {

ShadingModel::~ShadingModel() = default;

void ShadingModel::vertex_normals(const MeshView& mesh, const Vec3Span& normals) const {
    for (std::size_t group = 0; group < mesh.group_count; ++group) normals.set(group, {});
    std::vector<bool> is_given;
    if (mesh.authored_normal) {
        is_given.resize(mesh.group_count, false);
        for (std::size_t v = 0; v < mesh.vertex_count; ++v) {
            if (mesh.authored_normal[v] == Vec3{}) continue;
            normals.set(mesh.smooth_group[v], mesh.authored_normal[v]);
            is_given[mesh.smooth_group[v]] = true;
        }
    }
    for (std::size_t corner = 0; corner < mesh.indices.size(); ++corner) {
        const std::uint32_t group = mesh.smooth_group[mesh.indices[corner]];
        if (!is_given.empty() && is_given[group]) continue;
        normals.set(group, normals[group] + mesh.face_normal[corner / 3]);
    }
    for (std::size_t group = 0; group < mesh.group_count; ++group) {
        if (is_given.empty() || !is_given[group]) normals.set(group, normalized(normals[group]));
    }
}

}  // namespace candela
