// Points on surfaces, in batches.
module;

#include "candela/plugin/export.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

export module candela.raster:points;

import candela.api;
import candela.util;

export namespace candela {

/// The number of points shaded at once: enough to amortise a virtual call, few enough to stay in the
/// first-level cache.
inline constexpr std::size_t k_batch_size = 256;

/// Points on one object's surface, as a structure of arrays with room for k_batch_size. Reused from batch to
/// batch.
struct CANDELA_EXPORT SurfacePoints {
    SurfacePoints();

    std::size_t count = 0;
    std::size_t filled = 0;  // whole_vectors(count) or count: past `count`, the last point is repeated
    Vec3Arrays position;
    Vec3Arrays face_normal;    // unit
    Vec3Arrays vertex_normal;  // interpolated; not unit
    Vec3Arrays barycentric;
    AlignedVector<float> facing;  // 1, or -1 where an open surface is seen from behind
    bool any_from_behind = false;
    // The pixel of a fragment, and the fraction of its samples; filled if requested, zero elsewhere.
    AlignedVector<std::uint32_t> pixel_x, pixel_y;
    AlignedVector<float> coverage;
    AlignedVector<std::uint32_t> triangle;        // filled if has_triangle
    bool has_triangle = false;                    // each point lies on one triangle, and it was requested
    AlignedVector<float> u, v;                    // filled if requested and the mesh has them, otherwise zero
    AlignedVector<float> dudx, dvdx, dudy, dvdy;  // per pixel to the right and downwards; zero if unknown
    Vec3Arrays dpdu, dpdv;
    Vec3Arrays color;                            // the mesh's; filled if has_color
    bool has_color = false;                      // the mesh has colours, and they were requested
    std::vector<AlignedVector<float>> channels;  // the mesh's, if requested
    /// Like dudx, dvdx, dudy, dvdy, of the mesh's second texture coordinates.
    std::array<AlignedVector<float>, 4> second_footprint;
    std::array<Vec3Arrays, 3> corner_position;     // of each point's triangle; empty until first requested
    std::array<Vec3Arrays, 3> corner_normal;       // unit
    std::vector<AlignedVector<float>> parameters;  // of the material, where they vary (candela.shading)
};

/// The attributes of a point that are needed. Others may be filled as well.
struct PointNeeds {
    bool position = true;
    bool face_normal = true;
    bool vertex_normal = true;
    bool barycentric = true;
    bool color = true;  // of a mesh that has colours
    bool uv = false;
    bool pixel = false;           // of fragments
    bool triangle_index = false;  // of fragments, faces and places; vertices have none
    bool footprint = false;       // how uv change from pixel to pixel; with uv, at fragments
    bool derivatives = false;
    bool triangle = false;  // of fragments, faces and places; vertices have none
    bool channels = false;  // of a mesh that has further ones; with `footprint`, that of its second uv, too

    /// Whether anything is needed that is not interpolated in the same pass.
    constexpr bool more() const { return color || uv || derivatives || triangle || channels; }
};

}  // namespace candela
