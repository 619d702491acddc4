// From visibility to points of surfaces: faces, vertices and fragments, gathered in batches.
module;

#include "candela/api.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

export module candela.fragments;

import candela.math;
import candela.mesh;
import candela.raster;

export namespace candela {

/// How many points are shaded at once: enough to hide a virtual call, few enough to stay in the first-level
/// cache.
inline constexpr std::size_t k_batch_size = 256;

/// Points of one object's surface, structure of arrays with room for k_batch_size. Reused from batch to
/// batch.
struct CANDELA_API SurfacePoints {
    SurfacePoints();

    std::size_t count = 0;
    Vec3Arrays position;
    Vec3Arrays face_normal;    // unit
    Vec3Arrays vertex_normal;  // interpolated; not unit
    Vec3Arrays barycentric;
    std::vector<float> facing;  // 1, or -1 where an open surface is seen from behind
    std::vector<float> u, v;    // filled where attributes are asked for and the mesh has them, else zero
    Vec3Arrays dpdu, dpdv;
};

/// Which attributes of a point somebody reads beyond those that all read.
struct PointNeeds {
    bool uv = false;
    bool derivatives = false;
};

/// The fragments of one object in one tile, in the order of their pixels: each is what one triangle
/// contributes to one pixel.
struct FragmentList {
    std::uint32_t object = 0;
    std::vector<std::uint32_t> triangle;  // of the object's mesh
    std::vector<float> x, y;              // where it is evaluated, in pixels of the picture
    std::vector<std::uint32_t> pixel;     // of the tile: row * stride + column
    std::vector<float> weight;            // the share of the pixel's samples that see it

    inline std::size_t size() const { return triangle.size(); }
    void clear();
    void add(std::uint32_t triangle_index, float at_x, float at_y, std::uint32_t at_pixel, float share);
    /// Adds `count` whole pixels of a row, from the one at `at_pixel` whose middle is at (at_x, at_y).
    void add_run(std::uint32_t triangle_index, float at_x, float at_y, std::uint32_t at_pixel,
                 std::size_t count);
};

/// All fragments of a tile, one list an object, in the scene's order. Reused from tile to tile.
class CANDELA_API TileFragments {
  public:
    /// Sorts what `visibility` holds. `background_weight` receives, per pixel of the tile, the share that
    /// sees no object.
    void collect(const ProjectedScene& scene, const TileVisibility& visibility,
                 std::vector<float>& background_weight);

    std::span<const FragmentList> lists() const { return {lists_.data(), used_}; }

  private:
    FragmentList& list_of(const ProjectedScene& scene, std::uint32_t triangle);
    void collect_pixels(const ProjectedScene& scene, const TileVisibility& visibility,
                        std::vector<float>& background_weight);
    void collect_samples(const ProjectedScene& scene, const TileVisibility& visibility,
                         std::vector<float>& background_weight);

    std::vector<FragmentList> lists_;
    std::size_t used_ = 0;
    std::size_t last_ = 0;
};

/// One mesh of a projected scene.
struct ProjectedMesh {
    const ProjectedScene& scene;
    const Mesh& mesh;
    std::uint32_t first_vertex;

    /// Whether the triangle is seen from behind.
    bool is_back(std::uint32_t triangle) const;
};

/// Fills `points` with the fragments [first, first + count), count <= k_batch_size: barycentric coordinates
/// on the triangle itself (Blinn 1992, "Hyperbolic interpolation"), and what follows from them.
CANDELA_API void gather_fragments(const ProjectedMesh& mesh, const FragmentList& fragments, std::size_t first,
                                  std::size_t count, PointNeeds needs, SurfacePoints& points);

/// Fills `points` with the centroids of triangles.
CANDELA_API void gather_faces(const ProjectedMesh& mesh, std::span<const std::uint32_t> triangles,
                              PointNeeds needs, SurfacePoints& points);

/// A vertex, seen from the front or from behind.
struct VertexSide {
    std::uint32_t vertex;
    bool is_back;

    friend auto operator<=>(const VertexSide&, const VertexSide&) = default;
};

/// Fills `points` with vertices. A vertex has no face of its own: its face normal is its vertex normal.
CANDELA_API void gather_vertices(const ProjectedMesh& mesh, std::span<const VertexSide> vertices,
                                 PointNeeds needs, SurfacePoints& points);

/// Fills `points` with points on triangles, their barycentric coordinates given; all are seen from the front.
CANDELA_API void gather_places(const Mesh& mesh, std::span<const std::uint32_t> triangles,
                               ConstVec3Span barycentric, PointNeeds needs, SurfacePoints& points);

}  // namespace candela
