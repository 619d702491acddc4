// From visibility to surface points: faces, vertices and fragments, gathered in batches.
module;

#include "candela/plugin/export.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

export module candela.raster:fragments;

import :camera;
export import :points;
import :projected_scene;
import :visibility;
import candela.api;
import candela.geometry;
import candela.util;

export namespace candela {

/// Adjacent pixels of a row to which triangles of one object contribute equal shares.
struct FragmentRun {
    std::uint32_t pixel;  // the first: row * stride + column of the tile
    std::uint32_t count;
    float x,
        y;         // of the first, in pixels of the picture; the others follow to the right
    float weight;  // the fraction of a pixel's samples that see the triangle
};

/// The fragments of one object in one tile, in the order of their pixels. A fragment is what one triangle
/// contributes to one pixel.
struct FragmentList {
    std::uint32_t object = 0;
    std::vector<FragmentRun> runs;           // split where a batch of k_batch_size ends
    AlignedVector<std::uint32_t> triangles;  // of the object's mesh, one for each fragment

    void begin(std::uint32_t of_object);
    /// The run's fragments see `seen`, triangles numbered within the scene; `first_triangle` is the number of
    /// the object's first one.
    void add(FragmentRun run, const std::uint32_t* seen, std::uint32_t first_triangle);
    /// Extends the last run by a pixel.
    void prolong(std::uint32_t seen, std::uint32_t first_triangle);

  private:
    std::uint32_t room_ = k_batch_size;  // in the last batch
};

/// Adjacent pixels of a row that see more than one triangle; `weight` of each sees the background.
struct BackgroundRun {
    std::uint32_t pixel;
    std::uint32_t count;
    float weight;
};

/// All fragments of a tile, one list per object, in the scene's order. Reused from tile to tile.
class CANDELA_EXPORT TileFragments {
  public:
    /// Sorts the samples of `visibility` into fragments.
    void collect(const ProjectedScene& scene, const TileVisibility& visibility);

    /// Sorts them if surfaces let what is behind them through: `left` is the fraction of each sample, in the
    /// order of TileVisibility::triangle, that is not covered by anything nearer, and `opacity` the fraction
    /// of that which its surface covers. Samples that are covered are not part of any fragment. The
    /// background's weights are those of samples without a triangle; runs of weight 0, of pixels that see
    /// several triangles or parts of them, only if `is_nearest`.
    void collect_layer(const ProjectedScene& scene, const TileVisibility& visibility,
                       std::span<const float> left, std::span<const float> opacity, bool is_nearest);

    std::span<const FragmentList> lists() const { return {lists_.data(), used_}; }

    /// The pixels whose intensity does not come from a single fragment.
    std::span<const BackgroundRun> background() const { return background_; }

    /// The number of pixels that see an object.
    std::size_t pixels_seen() const { return pixels_seen_; }

  private:
    FragmentList& list_of(const ProjectedScene& scene, std::uint32_t triangle);
    void collect_pixels(const ProjectedScene& scene, const TileVisibility& visibility);
    void collect_samples(const ProjectedScene& scene, const TileVisibility& visibility);
    void begin();
    void sort();
    void add_fragment(const ProjectedScene& scene, std::uint32_t triangle, const FragmentRun& fragment,
                      int column);
    void add_background(std::uint32_t pixel, int column, float weight);

    std::vector<FragmentList> lists_;
    std::vector<BackgroundRun> background_;
    std::size_t pixels_seen_ = 0;
    std::size_t used_ = 0;
    std::size_t last_ = 0;
};

/// Fragments that are shaded together.
struct FragmentBatch {
    std::span<const FragmentRun> runs;
    std::span<const std::uint32_t> triangles;  // of each fragment
};

/// Splits a list into batches of k_batch_size fragments; the last may have fewer.
class FragmentBatches {
  public:
    explicit FragmentBatches(const FragmentList& list) : runs_(list.runs), triangles_(list.triangles) {}

    /// Returns the next batch; empty at the end.
    inline FragmentBatch next() {
        std::size_t runs = 0, fragments = 0;
        for (; runs < runs_.size() && fragments < k_batch_size; ++runs) fragments += runs_[runs].count;
        const FragmentBatch batch{runs_.first(runs), triangles_.first(fragments)};
        runs_ = runs_.subspan(runs);
        triangles_ = triangles_.subspan(fragments);
        return batch;
    }

  private:
    std::span<const FragmentRun> runs_;
    std::span<const std::uint32_t> triangles_;
};

/// One mesh of a projected scene.
struct ProjectedMesh {
    const ProjectedScene& scene;
    const Mesh& mesh;
    std::uint32_t first_vertex;

    /// Whether the triangle is seen from behind.
    bool is_back(std::uint32_t triangle) const;
};

/// Fills `points` with the fragments of a batch: barycentric coordinates on the triangle itself (Blinn 1992,
/// "Hyperbolic interpolation"), and everything derived from them.
CANDELA_EXPORT void gather_fragments(const ProjectedMesh& mesh, const FragmentBatch& batch, PointNeeds needs,
                                     SurfacePoints& points);

/// Fills `points` with the centroids of triangles.
CANDELA_EXPORT void gather_faces(const ProjectedMesh& mesh, std::span<const std::uint32_t> triangles,
                                 PointNeeds needs, SurfacePoints& points);

/// A vertex seen from the front or from behind.
struct VertexSide {
    std::uint32_t vertex;
    bool is_back;
};

/// Fills `points` with vertices. A vertex has no face of its own, so its vertex normal also serves as its
/// face normal.
CANDELA_EXPORT void gather_vertices(const ProjectedMesh& mesh, std::span<const VertexSide> vertices,
                                    PointNeeds needs, SurfacePoints& points);

/// Fills `points` with points on triangles, given their barycentric coordinates; all are seen from the front.
CANDELA_EXPORT void gather_places(const Mesh& mesh, std::span<const std::uint32_t> triangles,
                                  ConstVec3Span barycentric, PointNeeds needs, SurfacePoints& points);

}  // namespace candela
