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

/// A triangle, or a piece of a clipped one, in fixed-point pixels; wound so that its area is positive with y
/// down.
struct RasterTriangle {
    std::int32_t x[3];
    std::int32_t y[3];
    float depth[3];  // linear on the screen; larger is nearer
    std::uint32_t id;
};

/// A vertex in homogeneous pixels: it is seen at (x / w, y / w).
struct alignas(16) ProjectedVertex {
    float x, y;
    float w;         // in perspective the distance, in an orthographic view 1
    float distance;  // along the view
};

/// A vertex in fixed-point pixels; what of it lies outside the view, as bits that Outside names.
struct ScreenVertex {
    std::int32_t x, y;
    float depth;
    std::uint32_t outside;
};

/// The triangles of one stretch of the scene, by tile.
struct TriangleBin {
    std::vector<RasterTriangle> triangles;
    int first_column = 0, columns = 0, first_row = 0, rows = 0;  // tiles that the stretch touches
    std::vector<std::uint32_t> start;  // of each tile's list in `entries`; one more than tiles
    std::vector<std::uint32_t> entries;
};

/// A scene as the camera sees it: the same for all tiles. Immutable once made.
struct ProjectedScene {
    Camera camera;
    int tile_size = 64;
    int samples = 1;
    int subpixel_bits = 8;
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

/// Tiles are squares of `tile_size` pixels, a power of two from 16 on. Triangles are numbered through all
/// meshes. Throws std::length_error where there are more than 2^32 - 2 triangles or vertices.
CANDELA_API ProjectedScene project(std::span<const Mesh* const> meshes, const Camera& camera, int tile_size,
                                   int samples);

/// The same, in the memory of a scene that was projected before.
CANDELA_API void project(std::span<const Mesh* const> meshes, const Camera& camera, int tile_size,
                         int samples, ProjectedScene& scene);

}  // namespace candela
