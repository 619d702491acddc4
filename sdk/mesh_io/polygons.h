// Polygons of any number of corners, cut into triangles.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh_io/surface.h"

namespace mesh_io {

/// Faces as a file lists them.
struct Polygons {
    Array<std::uint32_t> corners;  // vertices, face after face
    Array<std::uint32_t> ends;     // per face, where the next one begins
    std::uint64_t too_small = 0;   // faces of fewer than three corners, which were left out

    /// Ends the face that began with the first corner after the previous face.
    void end_face();
};

/// Appends the triangles of a face to `indices`: n - 2 of n corners, in the face's orientation. A concave
/// face is cut by clipping ears (Meisters 1975) in the plane of its Newell normal; one that crosses itself
/// yields some n - 2 triangles. Throws BadFile if it has more reflex corners than can be handled in time.
void triangulate(std::span<const std::uint32_t> corners, candela::ConstVec3Span position,
                 Array<std::uint32_t>& indices);

/// Throws BadFile if a corner is not one of so many vertices.
void require_vertices(const Polygons& polygons, std::size_t vertices);

/// Sets `surface.indices` to the triangles of all faces and, unless `smoothing` (per face) is empty,
/// `surface.smoothing`. Throws BadFile if a corner's vertex does not exist.
void triangulate(const Polygons& polygons, std::span<const std::uint32_t> smoothing, Surface& surface);

}  // namespace mesh_io
