module;

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

module candela.render:tile_layers;

import :render_scene;
import candela.api;
import candela.raster;
import candela.shading;
import candela.util;

namespace candela {

/// The visible fragments of one tile.
struct VisibleTile {
    int x0 = 0, y0 = 0, width = 0, height = 0, stride = 0;  // as in TileVisibility
    bool is_empty = true;                                   // shows only the background
    TileFragments fragments;

    std::size_t plane() const { return static_cast<std::size_t>(stride) * static_cast<std::size_t>(stride); }
};

/// Whether a tile sees a surface that something may be seen through.
bool has_layers(const RenderScene& scene, const VisibleTile& visible);

/// The surfaces that such a tile shows, layer by layer: at each sample, the nearest surface that is there,
/// then the next one behind it, until nothing is left of the sample to cover (depth peeling). Opacity is a
/// matter of visibility, so it is found at each sample, whatever the shading model. Holds one layer at a
/// time, and is reused from tile to tile.
class TileLayers {
  public:
    /// Sets the tile for the following calls. `blends`: surfaces cover according to their opacity; otherwise
    /// those that are there at all are opaque.
    void begin(const RenderScene& scene, const ProjectedScene& projected, const VisibleTile& tile,
               bool blends);

    /// Finds the first layer, or the next one; false if there is none.
    bool next();

    /// The fragments and the background that the layer shows, with their weights.
    const VisibleTile& layer() const { return layer_; }
    /// The number of layers before it.
    std::size_t number() const { return number_; }

    /// A triangle, numbered within the scene, in the layer: the fraction that it covers of what is left of
    /// those samples of a pixel that see it.
    float opacity_of(std::uint32_t triangle, std::uint32_t pixel) const;

  private:
    static constexpr float k_unknown = -1;
    static constexpr float k_nowhere = -std::numeric_limits<float>::infinity();

    /// Calls `visit(sample)` with the index of each sample in the picture, plane by plane and row by row.
    template <class Visit>
    void each_sample(Visit visit) const;
    void go_behind();
    void skip_absent();
    void find_opacities();
    void flush();
    std::uint32_t object_of(std::uint32_t triangle);

    const RenderScene* scene_ = nullptr;
    const ProjectedScene* projected_ = nullptr;
    bool blends_ = true;
    bool is_first_ = true;
    std::size_t number_ = 0;
    VisibleTile layer_;
    TileVisibility visibility_, before_, behind_;
    AlignedVector<float> left_;     // of each sample: what nearer surfaces do not cover
    AlignedVector<float> opacity_;  // of its surface; k_unknown until it is found

    // A batch of samples whose opacity a texture gives.
    std::uint32_t object_ = 0;  // the last one looked up
    std::uint32_t batch_object_ = 0;
    std::vector<FragmentRun> runs_;
    std::vector<std::uint32_t> triangles_;
    std::vector<std::size_t> places_;  // in opacity_
    SurfacePoints points_;
    AlignedVector<float> found_;
};

}  // namespace candela
