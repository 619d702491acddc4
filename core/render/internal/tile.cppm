module;

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

module candela.render:tile;

import :render_scene;
import :film;
import :sparse_set;
import :tile_layers;
import candela.api;
import candela.raster;
import candela.scene;
import candela.shading;
import candela.util;

namespace candela {

/// Whether the background is shown (see RenderOptions).
bool shows_background(Term term, std::optional<std::size_t> light);

/// The light, and what may block it. `transmitters` is filled, and referred to.
LightingContext lighting_context(const RenderScene& scene, const Camera& camera,
                                 std::vector<Transmitter>& transmitters);
ShadedObject shaded_object(const RenderScene& scene, std::uint32_t index);
PointNeeds needs_of(const RenderScene& scene, const SurfaceModels& surface);

/// Turns the fragments of a tile into pixels. Owns a tile's arrays: use one per thread.
class TileShader {
  public:
    TileShader();

    /// Sets the scene for the following calls and what is shown of it (see RenderOptions), and resets the
    /// counts.
    void begin(const RenderScene& scene, const ProjectedScene& projected, Term term = Term::intensity,
               std::optional<std::size_t> light = {}, std::span<const ShownParameter> parameter = {});

    Term term() const { return term_; }
    const ProjectedScene& projected() const { return *projected_; }

    /// Fills the tile's pixels with the background, weighted by the fraction of each pixel that shows it.
    void fill_background(const VisibleTile& visible);
    /// Adds the background that a layer behind others shows.
    void add_background(const VisibleTile& layer);

    // Adds one object's fragments to the tile's pixels, lit once per fragment, face or vertex.
    void shade_fragments(const FragmentList& fragments);
    void shade_faces(const FragmentList& fragments);
    void shade_vertices(const FragmentList& fragments);
    /// Writes a geometric term to the fragments' pixels.
    void show_geometry(const FragmentList& fragments);

    /// The tile's intensities, rows VisibleTile::stride apart.
    ConstVec3Span pixels() const { return pixels_.span(); }

    std::size_t points_lit() const { return points_lit_; }
    float brightest() const { return brightest_; }

  private:
    ProjectedMesh mesh_of(const FragmentList& fragments) const;
    Vec3 geometry_at(std::size_t point, std::uint32_t object, std::uint32_t triangle) const;
    void shade_points(std::uint32_t object, const Vec3Span& intensity);
    void accumulate(std::span<const FragmentRun> runs, const ConstVec3Span& intensity);

    const RenderScene* scene_ = nullptr;
    const ProjectedScene* projected_ = nullptr;
    Term term_ = Term::intensity;
    std::span<const ShownParameter> parameter_;
    bool has_background_ = true;
    std::vector<Transmitter> transmitters_;
    SurfaceShader surface_shader_;
    SurfacePoints points_;
    SparseSet sparse_set_;              // of a tile's faces, or sides of vertices
    std::vector<VertexSide> vertices_;  // in the order of their numbers in it
    Vec3Arrays batch_;                  // intensities of one batch
    Vec3Arrays places_;                 // of a tile's faces or vertices
    Vec3Arrays pixels_;
    Vec3Arrays towards_;  // the lines of sight of a run's pixels
    Vec3Arrays seen_;     // what they see of the background
    std::size_t points_lit_ = 0;
    float brightest_ = 0;
};

/// One thread's workspace, reused from tile to tile.
struct TileWorker {
    TileVisibility visibility;
    VisibleTile visible;
    TileLayers layers;
    TileShader shader;
    std::size_t pixels_shaded = 0;
};

// The stages of the pipeline; see pipeline.cpp.

/// Projects a scene's meshes and sorts their triangles into the tiles that overlap these rows of the picture.
/// Throws Error.
void project_scene(const RenderScene& scene, int width, int height, RowRange rows, int tile_size, int samples,
                   ProjectedScene& projected);

/// The value of all pixels that show no object, if it is the same for all.
std::optional<Rgb> uniform_background(const RenderScene& scene, Term term, std::optional<std::size_t> light);

/// Fills the tiles of a row that no triangle comes near with that background, and sets `is_done`, by column.
void fill_empty_tiles(const ProjectedScene& projected, int row, Rgb background, Film& film,
                      std::span<std::uint8_t> is_done);

/// Finds the visible fragments of a tile.
void find_visible(const ProjectedScene& projected, int tile, TileVisibility& visibility,
                  VisibleTile& visible);

/// Shades a tile's fragments and stores its pixels.
void shade_tile(const RenderScene& scene, const VisibleTile& visible, TileWorker& worker, Film& film);

}  // namespace candela
