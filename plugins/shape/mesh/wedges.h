// What a file says of the corners of faces, or of faces, rather than of vertices.
#pragma once

#include "polygons.h"
#include "surface.h"

namespace mesh {

struct Wedges {
    Array<float> u, v;   // per corner of the polygons, or empty
    Vectors face_color;  // per face, or empty

    bool empty() const { return u.empty() && face_color.empty(); }
};

/// Makes a vertex of each combination of a vertex, texture coordinates and a colour that corners have, and
/// numbers the corners of `polygons` anew. Throws BadFile if a corner is no vertex.
void split_by_wedges(const Wedges& wedges, Polygons& polygons, Surface& surface);

}  // namespace mesh
