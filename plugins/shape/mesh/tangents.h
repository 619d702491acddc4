// Tangent frames at the vertices of a surface, as other programs make them for their normal maps.
#pragma once

#include "crease.h"
#include "mesh_io/surface.h"

namespace mesh {

/// A surface's vertices, and the partial derivatives of position with respect to texture coordinates there.
struct Tangents {
    SplitVertices vertices;
    mesh_io::Vectors dpdu, dpdv;  // zero where no triangle has an area both in space and in the texture
};

/// Their directions are the file's, or else those of MikkTSpace (Mikkelsen 2008, "Simulation of wrinkled
/// surfaces revisited"): the mean over a vertex's triangles, weighted by angle, of the derivatives along each
/// triangle, projected onto the plane of the vertex's normal; only triangles that are joined by edges and are
/// not mirrored in the texture share a frame, so that a vertex between others is split. Their lengths are
/// means with the same weights. Vertices at the same position with the same normal and texture coordinates
/// count as one. Where the file has no normal, that of the smooth group is the sum of its faces', weighted by
/// area. `split`: empty, or the surface's vertices; has texture coordinates.
Tangents tangents_of(const mesh_io::Surface& surface, const SplitVertices& split);

}  // namespace mesh
