// "Why is it black?"
#pragma once

#include <string>

import candela.render;

namespace candela {

/// Why a picture shows no light on any object, and what to do, as the end of the sentence "nothing in the
/// picture is lit: …". Empty if something is lit, or if the scene has no objects or no lights, which was
/// reported when it was read.
std::string darkness_diagnosis(const RenderScene& scene, const Film& film,
                               const RenderStatistics& statistics);

}  // namespace candela
