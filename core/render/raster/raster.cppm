// Visibility: which triangle each sample of the picture sees.
//
// Triangles are projected once per frame, sorted into tiles of the picture, and rasterised tile by tile. The
// results depend on neither the number of threads nor the size of the tiles.
module;

#include "candela/api.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

export module candela.raster;

import candela.arrays;
import candela.math;
import candela.mesh;
import candela.transform;

export namespace candela {

/// What the observer sees. Pixel (0, 0) is top left; the centre of pixel (x, y) is at (x + 1/2, y + 1/2).
struct CANDELA_API Camera {
    Vec3 eye;
    Vec3 right, up, forward;  // orthonormal
    Projection projection = Projection::perspective;
    float pixels_per_unit = 1;  // perspective: at distance one; orthographic: per metre
    int width = 1;
    int height = 1;

    /// `size`: perspective, the full vertical angle in degrees; orthographic, the height of the view in
    /// metres.
    static Camera looking(Vec3 eye, Vec3 look_at, Vec3 up, Projection projection, float size, int width,
                          int height);

    /// The unit vector from the eye through a point of the picture, in pixels from its top left.
    Vec3 view_through(float x, float y) const;
};

inline constexpr std::uint32_t k_no_triangle = 0xffff'ffffu;

/// Sub-pixel positions of the samples, in sixteenths of a pixel from its top left.
struct SamplePosition {
    std::uint8_t x, y;
};
/// For 1, 4, 8 or 16 samples per pixel: the centre, or the patterns of the D3D 11 specification.
CANDELA_API std::span<const SamplePosition> sample_pattern(int samples) noexcept;

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

/// What one tile sees. Reused from tile to tile.
struct TileVisibility {
    int x0 = 0, y0 = 0;         // its top left pixel
    int width = 0, height = 0;  // the pixels of it that are in the picture
    int stride = 0;             // of a row, a multiple of 16
    int samples = 1;
    AlignedVector<std::uint32_t> triangle;  // sample by sample, row by row; k_no_triangle: background
    AlignedVector<float> depth;

    inline std::size_t plane() const {
        return static_cast<std::size_t>(stride) * static_cast<std::size_t>(stride);
    }
    inline std::uint32_t at(int sample, int px, int py) const {
        return triangle[static_cast<std::size_t>(sample) * plane() +
                        static_cast<std::size_t>(py * stride + px)];
    }
};

/// Finds what tile `tile`, 0 <= tile < tile_count(), sees: the nearest triangle of each sample, the first one
/// among equally near ones; a sample on a shared edge belongs to one triangle only (top-left rule). Returns
/// false if no triangle comes near the tile; `visibility` then only has its position. Any thread.
CANDELA_API bool rasterize(const ProjectedScene& scene, int tile, TileVisibility& visibility);

}  // namespace candela

namespace candela {

/// Where a vertex lies: beyond which plane of the view volume, or beyond the guard band, where its
/// fixed-point pixels are useless; or nowhere, if its position is not finite.
struct Outside {
    static constexpr std::uint32_t near = 1, left = 2, right = 4, top = 8, bottom = 16;
    static constexpr std::uint32_t view = near | left | right | top | bottom;
    static constexpr std::uint32_t guard = 32, nowhere = 64;
};

/// The near plane: nothing closer to the eye than a tenth of a millimetre is seen (perspective only).
inline constexpr float k_near = 1e-4f;

/// Makes the fixed-point triangles of a range of a mesh, and sorts them into tiles. `first_id`: of the mesh's
/// first triangle.
void bin_triangles(const ProjectedScene& scene, const Mesh& mesh, std::uint32_t first_vertex,
                   std::uint32_t first_id, std::size_t first_triangle, std::size_t count, TriangleBin& bin);

/// Triangles whose box covers at most four by four pixels, processed together; one sample per pixel. Their
/// coverage and depth depend on the triangle alone, not on the tile.
struct SmallTriangles {
    static constexpr std::size_t k_size = 64;

    alignas(64) std::int32_t is_small[k_size];      // otherwise the rest is undefined
    alignas(64) std::int32_t x[k_size], y[k_size];  // of the box's first pixel
    alignas(64) std::int32_t covered[k_size];       // bit 4 * row + column of the box
    alignas(64) float depth[k_size];            // at the first pixel
    alignas(64) float to_right[k_size], down[k_size];

    /// Sets up `count` <= k_size triangles of `all`, given their indices.
    void set_up(const RasterTriangle* all, const std::uint32_t* numbers, std::size_t count,
                int subpixel_bits);
};

}  // namespace candela
