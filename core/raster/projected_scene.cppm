module;

#include "candela/plugin/export.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

export module candela.raster:projected_scene;

import :camera;
import candela.geometry;
import candela.util;

export namespace candela {

/// A vertex in homogeneous pixels: on the screen at (x / w, y / w).
struct alignas(16) ProjectedVertex {
    float x, y;
    float w;         // the distance in perspective, 1 in an orthographic view
    float distance;  // along the view
};

/// A vertex in fixed-point pixels, with bits from Outside.
struct alignas(16) ScreenVertex {
    std::int32_t x, y;
    float depth;  // linear in screen space; larger is nearer
    std::uint32_t outside;
};

/// A triangle in fixed-point pixels, oriented so that its area is positive with y down.
struct RasterTriangle {
    ScreenVertex vertex[3];
    std::uint32_t id;
};

/// A triangle in a tile's list: its vertices in the scene, in that orientation; or a piece of a clipped one.
struct alignas(16) BinnedTriangle {
    static constexpr std::uint32_t k_piece = 0xffff'ffffu;

    std::uint32_t vertex[3];  // or k_piece, and the piece's number in the bin
    std::uint32_t id;

    [[gnu::always_inline]] inline bool is_piece() const { return vertex[0] == k_piece; }
};

/// The triangles of one range of the scene, by tile.
struct TriangleBin {
    int first_column = 0, columns = 0, first_row = 0, rows = 0;  // tiles that the range touches
    std::vector<std::uint32_t> start;       // start of each tile's list in `entries`; one more than there are
                                            // tiles
    AlignedVector<BinnedTriangle> entries;  // in the scene's order within each list
    std::vector<RasterTriangle> pieces;     // of clipped triangles

    /// The triangles in a tile.
    inline std::span<const BinnedTriangle> triangles_in(int column, int row) const {
        column -= first_column;
        row -= first_row;
        if (column < 0 || column >= columns || row < 0 || row >= rows) return {};
        const std::size_t list = static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                                 static_cast<std::size_t>(column);
        return std::span(entries).subspan(start[list], start[list + 1] - start[list]);
    }
};

/// Rows of tiles, from `first` up to but not including `end`.
struct TileRows {
    int first = 0;
    int end = 0;
};

/// A scene as the camera sees it, shared by all tiles. Immutable once made.
struct ProjectedScene {
    Camera camera;
    int tile_size = 64;
    int samples = 1;
    int subpixel_bits = 8;
    float near = 0;  // metres from the eye; anything closer is invisible (perspective only)
    int tile_columns = 0, tile_rows = 0;
    TileRows seen_rows;  // only their tiles have lists of triangles

    // Per vertex, all meshes in turn.
    AlignedVector<ProjectedVertex> vertices;
    AlignedVector<ScreenVertex> screen;
    bool is_moderate = true;                  // products of two homogeneous pixels are within a float's range
    std::vector<std::uint32_t> first_vertex;  // of each mesh
    std::vector<std::uint32_t> first_triangle;  // of each mesh, and the total

    std::vector<TriangleBin> bins;

    inline int tile_count() const { return tile_columns * tile_rows; }
    /// The number of the first tile with a list; those of the others follow.
    inline int first_seen_tile() const { return tile_columns * seen_rows.first; }
    inline int seen_tile_count() const { return tile_columns * (seen_rows.end - seen_rows.first); }
    /// Whether a triangle comes near that tile.
    inline bool is_near(int column, int row) const {
        return std::ranges::any_of(
            bins, [&](const TriangleBin& bin) { return !bin.triangles_in(column, row).empty(); });
    }
};

/// Tiles are squares of `tile_size` pixels, a power of two from 16 on. Triangles are numbered consecutively
/// over all meshes. Throws std::length_error if there are more than 2^32 - 2 triangles or vertices.
CANDELA_EXPORT ProjectedScene project(std::span<const Mesh* const> meshes, const Camera& camera,
                                      int tile_size, int samples);

/// Like the above, reusing the memory of a previously projected scene, for some rows of tiles or all.
CANDELA_EXPORT void project(std::span<const Mesh* const> meshes, const Camera& camera, int tile_size,
                            int samples, ProjectedScene& scene, std::optional<TileRows> rows = {});

}  // namespace candela
