// The stages in order: Scene -> meshes -> normals -> visibility -> fragments -> light -> reflection -> Film.
module;

#include "candela/api.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

export module candela.render;

import candela.diagnostics;
import candela.environment;
import candela.film;
import candela.fragments;
import candela.geometry;
import candela.math;
import candela.mesh;
import candela.raster;
import candela.registry;
import candela.scene;
import candela.shade;

export namespace candela {

/// An object with its triangles and its models.
struct SolidObject {
    std::string label;
    Mesh mesh;
    SurfaceModels surface;
    std::optional<TriangleTree> tree{};  // of the mesh, if the reflection model shows its surroundings
};

/// A scene with its plugins loaded and its objects tessellated: what all pictures of it share. Rendering does
/// not change it; between pictures its observer, lights, colours and models may be replaced at will (a
/// reflection model that shows its surroundings needs its object's tree).
struct CompiledScene {
    Observer observer;
    ImageSettings image;
    Environment environment;  // what is seen where there is no object
    std::vector<LitSource> lights;
    std::vector<SolidObject> objects;
};

/// Loads what the scene names, and nothing else, tessellates its objects and checks the constraints that only
/// triangles can decide. Reports failures with the light or object concerned, and then returns nothing, as it
/// does if errors were reported before; warns about meshes that are not closed. `threads`: as in
/// RenderOptions.
CANDELA_API std::optional<CompiledScene> compile(const SceneDraft& draft, Registry& registry,
                                                 Diagnostics& diagnostics, int threads = 0);
CANDELA_API std::optional<CompiledScene> compile(const Scene& scene, Registry& registry,
                                                 Diagnostics& diagnostics, int threads = 0);

struct RenderOptions {
    int threads = 0;    // 0: all, but one for a first picture that takes less time than starting the others
    int tile_size = 0;  // pixels, a power of two from 16 on; 0: chosen. The picture does not depend on it.
    std::function<void(std::size_t done, std::size_t all)>
        progress{};  // tiles; called by any thread, by several at once
};

struct RenderStatistics {
    std::size_t triangles = 0;
    std::size_t pixels_shaded = 0;  // pixels that show an object
    std::size_t points_lit = 0;     // faces, vertices and fragments at which light was evaluated
    float brightest = 0;            // the largest intensity of a channel at those points
    double seconds_projecting = 0;  // vertices, clipping, sorting into tiles
    double seconds_on_tiles = 0;    // visibility, light, reflection, pixels
};

/// Renders one picture: the same bytes for any number of threads and any tile size. Throws Error.
CANDELA_API RenderStatistics render(const CompiledScene& scene, Film& film, const RenderOptions& options);

/// Renders a sequence of pictures, each identical to that of candela::render(), and keeps from one to the
/// next what can be reused. One thread at a time.
class CANDELA_API Renderer {
  public:
    enum class Keep {
        memory,     // the arrays
        visibility  // also which triangle is seen where: if nothing but lights, colours or models has changed
                    // since the picture before, only light is evaluated; 24 bytes for each stretch of pixels
                    // that sees one triangle
    };
    explicit Renderer(Keep keep = Keep::memory);
    Renderer(Renderer&&) noexcept;
    Renderer& operator=(Renderer&&) noexcept;
    ~Renderer();

    /// Forgets visibility. Call it when a mesh has been changed in place; all other changes are detected.
    void forget() noexcept;

    RenderStatistics render(const CompiledScene& scene, Film& film, const RenderOptions& options);

  private:
    struct Kept;
    std::unique_ptr<Kept> kept_;
};

/// Why a picture shows no light on any object, and what to do, as the end of the sentence "nothing in the
/// picture is lit: …". Empty if something is lit, or if the scene has no objects or no lights, which reading
/// it has reported.
CANDELA_API std::string why_black(const CompiledScene& scene, const Film& film,
                                  const RenderStatistics& statistics);

}  // namespace candela

namespace candela {

/// The observer's camera for a picture of that size.
Camera camera_of(const Observer& observer, int width, int height);

/// What is visible in one tile.
struct SeenTile {
    int x0 = 0, y0 = 0, width = 0, height = 0, stride = 0;  // as in TileVisibility
    bool is_empty = true;                                   // nothing but the background
    TileFragments fragments;

    std::size_t plane() const { return static_cast<std::size_t>(stride) * static_cast<std::size_t>(stride); }
};

/// Finds what a tile sees. Owns a tile's arrays: use one per thread.
class TileViewer {
  public:
    void look(const ProjectedScene& projected, int tile, SeenTile& seen);

  private:
    TileVisibility visibility_;
};

/// Numbers distinct indices in order of arrival: a sparse set (Briggs, Torczon 1993), which is cleared at no
/// cost.
class SparseSet {
  public:
    /// Clears the set; indices to come are below `count`.
    void begin(std::size_t count) {
        if (number_.size() < count) number_.resize(count);
        indices_.clear();
    }
    void add(std::uint32_t index) {
        if (contains(index)) return;
        number_[index] = static_cast<std::uint32_t>(indices_.size());
        indices_.push_back(index);
    }
    std::uint32_t number_of(std::uint32_t index) const { return number_[index]; }
    std::span<const std::uint32_t> indices() const { return indices_; }

  private:
    bool contains(std::uint32_t index) const {
        const std::uint32_t number = number_[index];
        return number < indices_.size() && indices_[number] == index;
    }

    std::vector<std::uint32_t> number_;
    std::vector<std::uint32_t> indices_;
};

/// Turns what a tile sees into intensities. Owns a tile's arrays: use one per thread.
class TileShader {
  public:
    TileShader();

    /// Sets the scene for the following calls and resets the counts.
    void begin(const CompiledScene& scene, const ProjectedScene& projected);

    /// Shades what is visible and stores it.
    void run(const SeenTile& seen, Film& film);

    std::size_t pixels_shaded() const { return pixels_shaded_; }
    std::size_t points_lit() const { return points_lit_; }
    float brightest() const { return brightest_; }

  private:
    void shade(const FragmentList& fragments);
    void shade_fragments(const ProjectedMesh& mesh, const FragmentList& fragments);
    void shade_faces(const ProjectedMesh& mesh, const FragmentList& fragments);
    void shade_vertices(const ProjectedMesh& mesh, const FragmentList& fragments);
    void fill_background(const SeenTile& seen);
    void light(std::uint32_t object, const Vec3Span& intensity);
    void add(std::span<const FragmentRun> runs, const ConstVec3Span& intensity);

    const CompiledScene* scene_ = nullptr;
    const ProjectedScene* projected_ = nullptr;
    Lighting lighting_;
    SurfacePoints points_;
    SparseSet sparse_set_;              // of a tile's faces, or sides of vertices
    std::vector<VertexSide> vertices_;  // in the order of their numbers
    Vec3Arrays batch_;                  // intensities of one batch
    Vec3Arrays places_;                 // of a tile's faces or vertices
    Vec3Arrays pixels_;
    std::size_t pixels_shaded_ = 0;
    std::size_t points_lit_ = 0;
    float brightest_ = 0;
};

}  // namespace candela
