// Opacity in a generated C++ program.
#pragma once

#include <string>

#include "candela/target.h"
#include "candela/target/text_template.h"

namespace candela::cpp_target {

/// The template's placeholders for opacity. `shadows`: those for shadows. `cases`: the statements of
/// opacity_at() for objects whose opacity a texture gives.
target::Values opacity_texts(const ExportedScene& scene, const target::Values& shadows,
                             const std::string& cases);

/// The placeholders of the part for shadows, of a program whose objects let light pass or not.
target::Values opacity_of_shadows(const ExportedScene& scene);

}  // namespace candela::cpp_target
