// Surfaces in POV-Ray's scene language that something may be seen through.
#pragma once

#include <cstddef>
#include <string>

#include "candela/target.h"
#include "material.h"

namespace candela::povray_target {

/// Which part of what is behind it an object covers. POV-Ray's `transmit` would leave highlights as bright as
/// on an opaque surface; a texture map between a clear texture and the object's weighs the light of both.
class Cover {
  public:
    /// Writes the picture that gives the object's opacity, if there is one, to a file.
    Cover(const ExportedScene& scene, std::size_t object, FileSink& files);

    bool is_opaque() const { return pattern_.empty(); }
    bool has_texture() const { return has_texture_; }

    /// The material with this cover. Its textures, which may have layers, are declared under names that begin
    /// with `name`: maps take no layers otherwise.
    Material over(const Material& material, const std::string& name) const;
    /// A texture's statement with this cover; `texture`: what is in its braces.
    std::string over(const std::string& texture) const;

  private:
    std::string pattern_;         // empty if it is opaque
    float clear_ = 0, full_ = 0;  // of the map: places, or weights
    bool has_texture_ = false;
};

/// Before everything else in the scene's global_settings.
const char* trace_level_text(const ExportedScene& scene);

}  // namespace candela::povray_target
