module;

#include "candela/plugin/export.h"

#include <cstddef>
#include <span>
#include <vector>

export module candela.shading:radiance_map;

import candela.api;

export namespace candela {

/// A light from everywhere, as seen in all directions, for highlights that mirror it: an octahedral map with
/// levels, each texel the mean of the intensity over its directions. candela/kernel/mirror.kernel looks it
/// up. Immutable; any thread.
class CANDELA_EXPORT RadianceMap {
  public:
    /// `samples`: how many distant lights stand for the light. Made with the threads that with_threads()
    /// allows.
    RadianceMap(const SkySource& sky, int samples);

    /// Texels per row of the finest level: a power of two.
    int size() const noexcept { return size_; }
    /// Red, green and blue of each texel, level after level, down to a single texel.
    std::span<const float> texels() const noexcept { return texels_; }
    /// The number of samples over the integral of the light's luminance; 0 if it is dark.
    float density() const noexcept { return density_; }

  private:
    int size_;
    std::vector<float> texels_;
    float density_ = 0;
};

}  // namespace candela
