module;

#include "candela/plugin/export.h"

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>

export module candela.render:renderer;

import :render_scene;
import :film;
import candela.shading;

export namespace candela {

struct RenderOptions {
    /// The value written to the pixels: the intensity, or another term, stored in a film of floats. Geometric
    /// terms are those of a picture with one sample per pixel.
    Term term = Term::intensity;
    std::span<const ShownParameter> parameter{};  // with Term::parameter: by object
    std::optional<std::size_t> light{};  // an index: that light alone, without background and surroundings
    int threads = 0;    // 0: all, but only one for a first picture that takes less time than starting the
                        // others
    int tile_size = 0;  // pixels, a power of two from 16 on; 0: automatic. The picture does not depend on it.
    std::function<void(std::size_t done, std::size_t all)>
        progress{};  // tiles; called by any thread, possibly several at once
};

/// How 8-bit pictures show the scene.
CANDELA_EXPORT DisplayTransform display_of(const RenderScene& scene);

struct RenderStatistics {
    std::size_t triangles = 0;
    std::size_t pixels_shaded = 0;  // pixels that show an object
    std::size_t points_lit = 0;     // faces, vertices and fragments at which light was evaluated
    float brightest = 0;            // the largest intensity of a channel at those points
    double seconds_projecting = 0;  // vertices, clipping, sorting into tiles
    double seconds_on_tiles = 0;    // visibility, light, reflection, pixels
};

/// Renders one picture: the same bytes for any number of threads and any tile size. Throws Error.
CANDELA_EXPORT RenderStatistics render(const RenderScene& scene, Film& film, const RenderOptions& options);

/// Renders a sequence of pictures, each identical to that of candela::render(), and reuses what it can from
/// one to the next. One thread at a time.
class CANDELA_EXPORT Renderer {
  public:
    enum class Keep {
        memory,     // the arrays
        visibility  // also which triangle is visible where: if nothing but lights, colours or models has
                    // changed since the previous picture, only shading is repeated; 24 bytes per run of
                    // pixels that see one triangle
    };
    explicit Renderer(Keep keep = Keep::memory);
    Renderer(Renderer&&) noexcept;
    Renderer& operator=(Renderer&&) noexcept;
    ~Renderer();

    /// Discards the visibility. Call it when a mesh has been changed in place; all other changes are
    /// detected.
    void forget() noexcept;

    RenderStatistics render(const RenderScene& scene, Film& film, const RenderOptions& options);

  private:
    struct Kept;
    std::unique_ptr<Kept> kept_;
};

}  // namespace candela
