module;

#include "candela/api.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

export module candela.raster:projected_scene;

import :camera;
import candela.arrays;
import candela.mesh;

export namespace candela {

/// A triangle, or a piece of a clipped one, in fixed-point pixels, with an orientation that makes its area
/// positive with y down.
struct RasterTriangle {
    std::int32_t x[3];
    std::int32_t y[3];
    float depth[3];  // linear in screen space; larger is nearer
    std::uint32_t id;
};

/// A vertex in homogeneous pixels: on the screen at (x / w, y / w).
struct alignas(16) ProjectedVertex {
    float x, y;
    float w;         // the distance in perspective, 1 in an orthographic view
    float distance;  // along the view
};

/// A vertex in fixed-point pixels, with bits from Outside.
struct ScreenVertex {
    std::int32_t x, y;
    float depth;
    std::uint32_t outside;
};

/// The triangles of one range of the scene, by tile.
struct TriangleBin {
    std::vector<RasterTriangle> triangles;
    int first_column = 0, columns = 0, first_row = 0, rows = 0;  // tiles that the range touches
    std::vector<std::uint32_t> start;  // of each tile's list in `entries`; one more than there are tiles
    std::vector<std::uint32_t> entries;
};

/// A scene as the camera sees it: shared by all tiles. Immutable once made.
struct ProjectedScene {
    Camera camera;
    int tile_size = 64;
    int samples = 1;
    int subpixel_bits = 8;
    float near = 0;  // metres from the eye: nothing closer is seen (perspective only)
    int tile_columns = 0, tile_rows = 0;

    // Per vertex, all meshes in turn.
    AlignedVector<ProjectedVertex> vertices;
    AlignedVector<ScreenVertex> screen;
    bool is_moderate = true;                  // products of two homogeneous pixels are within a float's range
    std::vector<std::uint32_t> first_vertex;  // of each mesh
    std::vector<std::uint32_t> first_triangle;  // of each mesh, and the total

    std::vector<TriangleBin> bins;

    inline int tile_count() const { return tile_columns * tile_rows; }
};

/// Tiles are squares of `tile_size` pixels, a power of two from 16 on. Triangles are numbered consecutively
/// over all meshes. Throws std::length_error if there are more than 2^32 - 2 triangles or vertices.
CANDELA_API ProjectedScene project(std::span<const Mesh* const> meshes, const Camera& camera, int tile_size,
                                   int samples);

/// Same, reusing the memory of a previously projected scene.
CANDELA_API void project(std::span<const Mesh* const> meshes, const Camera& camera, int tile_size,
                         int samples, ProjectedScene& scene);

}  // namespace candela
