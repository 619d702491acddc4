// Attributes that a file gives to corners of faces, or to faces, rather than to vertices.
#pragma once

#include "mesh_io/polygons.h"
#include "mesh_io/surface.h"

namespace mesh_io {

struct Wedges {
    Array<float> u, v;   // per corner of the polygons, or empty
    Vectors face_color;  // per face, or empty

    bool empty() const { return u.empty() && face_color.empty(); }
};

/// Makes a vertex of each combination of vertex, texture coordinates and colour that corners have, and
/// renumbers the corners of `polygons`. Throws BadFile if a corner's vertex does not exist.
void split_by_wedges(const Wedges& wedges, Polygons& polygons, Surface& surface);

}  // namespace mesh_io
