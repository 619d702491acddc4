// Separates the smooth parts of a surface at its hard edges.
#pragma once

#include "corners.h"
#include "mesh_io/surface.h"

namespace mesh {

/// The vertices that a surface needs so that normals differ across hard edges.
struct SplitVertices {
    mesh_io::Array<std::uint32_t> source;  // per vertex, the vertex of the surface that it is a copy of
    mesh_io::Array<std::uint32_t> group;  // per vertex: its smooth group; empty: each vertex is its own group
    mesh_io::Array<std::uint32_t> indices;  // three per triangle
};

/// Vertices with a normal from the file stay as they are. At each place, the corners of all other triangles
/// fall into smooth groups: two triangles belong together, directly or through others, if they have the same
/// smoothing group or, where the file has none, if the angle between their normals is at most `crease_angle`
/// (radians). Where more than a few dozen triangles meet, only neighbours are compared. Vertices that no
/// triangle uses are left out.
SplitVertices split_at_creases(const mesh_io::Surface& surface, const Corners& corners, double crease_angle);

}  // namespace mesh
