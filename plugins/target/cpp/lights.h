// Lights of a generated C++ program.
#pragma once

#include <string>

#include "candela/target.h"

namespace candela::cpp_target {

struct LightTexts {
    std::string constants;  // before objects: the lights of each model, or their number
    std::string flags;      // after them: how lights of one model cast shadows, where they differ
    std::string loops;      // statements that add up the light that a surface reflects
};
LightTexts lights_of(const ExportedScene& scene);

}  // namespace candela::cpp_target
