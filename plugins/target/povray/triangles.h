// The triangles of an object, in the form that POV-Ray reads.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "candela/target.h"
#include "vertex_values.h"

namespace candela::povray_target {

/// Three indices per triangle, counter-clockwise seen from outside.
struct Triangles {
    std::vector<Vec3> positions;
    std::vector<Vec3> normals;             // empty: those of the faces
    std::vector<std::array<float, 2>> uv;  // empty if no texture is visible
    VertexValues values;
    std::vector<std::uint32_t> indices;
    std::vector<std::uint32_t> normal_indices;  // empty: the same
};

/// `normal`: of the vertices; null: those of the faces.
Triangles triangles_of(const ExportedMesh& mesh, ConstVec3Span normal, bool is_textured,
                       VertexValues values = {});

/// POV-Ray draws a triangle with equal normals flat. If they are not the face's, one of them is turned by an
/// invisibly small angle.
void keep_equal_normals(Triangles& triangles);

/// Removes and returns the triangles that are seen from one side but have a normal on the other, as near the
/// outline of a coarse mesh, turned towards the observer. In an open mesh, POV-Ray would choose the wrong
/// side.
Triangles split_off_outline(Triangles& triangles, const ExportedObserver& observer);

/// The triangles, enlarged and a little above the surface, on both sides of one that is not solid: light that
/// is projected through them is not blocked on its way there.
Triangles shell_of(const ExportedMesh& mesh);

/// Whether no part of the object is between another part and a light that its triangle faces: it is solid and
/// convex, or flat. Large meshes are not looked at, and count as not convex.
bool is_convex(const ExportedMesh& mesh);

}  // namespace candela::povray_target
