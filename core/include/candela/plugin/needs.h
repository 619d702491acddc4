// The data at a point that a model reads: the host computes nothing else for it. A plugin declares them once,
// in its descriptor.
#pragma once

namespace candela {

/// The members of SurfaceBatch that a reflection model reads in addition to those that are always filled.
struct SurfaceNeeds {
    bool tangent = false;
    bool uv = false;  // zero on a mesh without texture coordinates
    /// Its kernel reads Surface::position; generated programs depend on it. SurfaceBatch::position is always
    /// filled.
    bool position = false;
    /// SurfaceBatch::varying: the model's parameters may be different at each point.
    bool varying = false;

    friend bool operator==(const SurfaceNeeds&, const SurfaceNeeds&) = default;
};

/// The members of ShadingPointBatch that a shading model reads. Others are not computed for it.
struct ShadingNeeds {
    bool face_normal = true;
    bool vertex_normal = true;
    bool barycentric = true;
    bool uv = false;
    bool derivatives = false;
    bool triangle = false;  // not at rate `vertex`: a vertex belongs to several triangles
    /// vertex_normals() is not overridden. Where a shape is faceted, vertices need no normals then.
    bool default_vertex_normals = false;

    friend bool operator==(const ShadingNeeds&, const ShadingNeeds&) = default;
};

}  // namespace candela
