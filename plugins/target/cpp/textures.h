// Textures of a generated C++ program.
#pragma once

#include <string>

#include "candela/target.h"

namespace candela::cpp_target {

/// Both are empty in a scene without textures.
struct TextureTexts {
    std::string
        declarations;  // before objects: a function texture_<number>() for each, and how it is looked up
    std::string seen;  // before light is evaluated: what an object's texture shows at a point
};
TextureTexts textures_of(const ExportedScene& scene);

/// What is said of the files beside the program.
const char* readme_of_textures();

}  // namespace candela::cpp_target
