// Textures of a generated C++ program.
#pragma once

#include <string>

#include "candela/target.h"

namespace candela::cpp_target {

/// The member of a mesh with numbers of its vertices, if textures need them.
const char* mesh_channels_of(const ExportedScene& scene);

/// Both are empty in a scene without textures.
struct TextureTexts {
    std::string declarations;  // before objects: a function texture_<number>() for each, and texture lookup
    std::string seen;          // before light is evaluated: an object's material at a point
};
TextureTexts textures_of(const ExportedScene& scene, const std::string& textured_materials);

/// The README's paragraph about the files next to the program.
const char* readme_of_textures();

}  // namespace candela::cpp_target
