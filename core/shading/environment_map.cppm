module;

#include "candela/plugin/export.h"

#include <cstddef>
#include <filesystem>
#include <vector>

export module candela.shading:environment_map;

import candela.api;
import candela.plugins;

export namespace candela {

/// The intensity from infinity, by direction: uniform, or from an environment map. Immutable; any thread.
class CANDELA_EXPORT EnvironmentMap {
  public:
    explicit EnvironmentMap(Rgb everywhere = {});
    /// An equirectangular picture: its centre is the view along -z, its right half is towards +x, its top row
    /// +y. `intensity`: per channel, interleaved, rows from the top.
    EnvironmentMap(int width, int height, std::vector<float> intensity);

    bool is_uniform() const noexcept { return width_ == 0; }
    /// The largest intensity over all directions and channels.
    float max_intensity() const noexcept { return max_intensity_; }
    /// The intensity in the direction `towards`, a unit vector, interpolated between neighbouring pixels.
    Rgb seen(Vec3 towards) const noexcept;
    /// Like seen(), in `count` directions.
    void look(std::size_t count, const ConstVec3Span& towards, const Vec3Span& intensity) const noexcept;

  private:
    Rgb everywhere_;
    float max_intensity_ = 0;
    int width_ = 0;
    int height_ = 0;
    std::vector<float> intensity_;
};

/// Reads a picture as an environment; 8-bit colours are decoded according to `encoding`. Throws Error if no
/// image plugin supports the format or the file is unreadable.
CANDELA_EXPORT EnvironmentMap read_environment(const std::filesystem::path& file, Registry& registry,
                                               ColorEncoding encoding);

/// The environment that shows a light.
CANDELA_EXPORT EnvironmentMap environment_of(const SkySource& sky);

}  // namespace candela
