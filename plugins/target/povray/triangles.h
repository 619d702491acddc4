// The triangles of an object, as POV-Ray takes them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "candela/target.h"

namespace candela::povray_target {

/// Three indices a triangle, counter-clockwise seen from outside.
struct Triangles {
    std::vector<Vec3> positions;
    std::vector<Vec3> normals;             // empty: those of the faces
    std::vector<std::array<float, 2>> uv;  // empty where no texture is seen
    std::vector<Vec3> colors;              // empty where the mesh has none
    std::vector<std::uint32_t> indices;
    std::vector<std::uint32_t> normal_indices;  // empty: the same
};

/// `normal`: of the vertices; null for those of the faces.
Triangles triangles_of(const ExportedMesh& mesh, ConstVec3Span normal, bool is_textured);

/// POV-Ray shows a triangle whose normals are equal as a flat one. Where they are not the face's, one of them
/// is turned by so little that it does not show.
void keep_equal_normals(Triangles& triangles);

/// Takes those triangles away that are seen from one side, but have a normal on the other: near the outline
/// of a coarse mesh. They are turned towards the observer. Of an open mesh, POV-Ray would take the wrong
/// side.
Triangles split_off_outline(Triangles& triangles, const ExportedObserver& observer);

}  // namespace candela::povray_target
