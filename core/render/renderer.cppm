module;

#include "candela/api.h"

#include <cstddef>
#include <functional>
#include <memory>
#include <string>

export module candela.render:renderer;

import :compiled_scene;
import candela.film;

export namespace candela {

struct RenderOptions {
    int threads = 0;  // 0: all, but one for a first picture that is done before others would start
    int tile_size =
        0;  // pixels, a power of two from 16 on; 0: chosen. The picture is the same whatever it is.
    std::function<void(std::size_t done, std::size_t all)>
        progress{};  // tiles; called by any thread, by several at once
};

struct RenderStatistics {
    std::size_t triangles = 0;
    std::size_t pixels_shaded = 0;  // that show an object
    std::size_t points_lit = 0;     // faces, vertices and fragments at which light was evaluated
    float brightest = 0;            // the largest intensity of a channel at those points
    double seconds_projecting = 0;  // vertices, clipping, sorting into tiles
    double seconds_on_tiles = 0;    // visibility, light, reflection, pixels
};

/// Renders one picture. The same bytes for any number of threads and any tile size. Throws Error.
CANDELA_API RenderStatistics render(const CompiledScene& scene, Film& film, const RenderOptions& options);

/// Renders pictures one after another, the same ones as candela::render(), and keeps from each to the next
/// what the next can use. One thread at a time.
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

    /// Forgets what is seen. To be called where a mesh has changed in place; all else is noticed.
    void forget() noexcept;

    RenderStatistics render(const CompiledScene& scene, Film& film, const RenderOptions& options);

  private:
    struct Kept;
    std::unique_ptr<Kept> kept_;
};

/// Why a picture shows no light on any object, as the end of the sentence "nothing in the picture is lit: …",
/// and what to do; empty where something is lit, or where the scene has no objects or no lights, which
/// reading it has reported.
CANDELA_API std::string why_black(const CompiledScene& scene, const Film& film,
                                  const RenderStatistics& statistics);

}  // namespace candela
