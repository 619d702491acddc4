// Colours of surfaces in POV-Ray's scene language.
#pragma once

#include <cstddef>
#include <string>

#include "candela/target.h"

namespace candela::povray_target {

/// A pigment, to be multiplied by `factor`, because pictures have no intensities above 1.
struct Pigment {
    std::string text;
    float factor = 1;
};

/// The pigment of one colour; if the object has a texture, of its picture multiplied by that colour, which is
/// written to a file whose name ends in `suffix`.
Pigment pigment_of(const ExportedScene& scene, std::size_t object, Vec3 color, const char* suffix,
                   FileSink& files);

/// A picture of a number, for a pigment in place of a colour; it is written to that file.
std::string image_map_of(const ExportedScene& scene, const ExportedTexturedNumber& number,
                         const std::string& name, FileSink& files);

/// POV-Ray's name for the transfer function of the scene's intensities.
const char* gamma_text(const ExportedScene& scene);

}  // namespace candela::povray_target
