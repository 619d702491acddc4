// Surfaces in POV-Ray's scene language that something may be seen through.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "candela/target.h"
#include "material.h"

namespace candela::povray_target {

/// Which part of what is behind it an object covers. POV-Ray's `transmit` would leave highlights as bright as
/// on an opaque surface; a texture map between a clear texture and the object's weighs the light of both.
class Cover {
  public:
    /// Writes the pictures that give the object's opacity to files.
    Cover(const ExportedScene& scene, std::size_t object, FileSink& files);

    bool is_opaque() const { return factors_.empty() && !is_of_vertices_; }
    bool has_texture() const { return has_texture_; }

    /// The material with this cover. Its textures, which may have layers, are declared under names that begin
    /// with `name`: maps take no layers otherwise. `opacity`: that of a vertex, a further factor.
    Material over(const Material& material, const std::string& name, std::optional<float> opacity = {}) const;
    /// A texture's statement with this cover; `texture`: what is in its braces.
    std::string over(const std::string& texture, std::optional<float> opacity = {}) const;

  private:
    struct Factor {
        std::string pattern;
        float clear = 0, full = 0;  // of the map: places, or weights

        std::string over(const std::string& texture) const;
    };
    static Factor average(float opacity, float cutoff);

    std::vector<Factor> factors_;  // of all points
    float cutoff_ = 0;
    bool is_of_vertices_ = false;
    bool has_texture_ = false;
};

/// Before everything else in the scene's global_settings.
const char* trace_level_text(const ExportedScene& scene);

}  // namespace candela::povray_target
