// Materials with textures, as parts of shaders.
#pragma once

#include <string>
#include <vector>

#include "candela/target.h"
#include "candela/target/glsl.h"

namespace candela::target {

/// For each object, GlslParts::materials.
std::vector<std::string> textured_materials(const ExportedScene& scene);
/// For each object, GlslParts::common_materials.
std::vector<std::string> textured_common_materials(const ExportedScene& scene);
/// Whether one of them is not empty.
bool has_common_textures(const ExportedScene& scene);

/// Declares own_emission and own_occlusion, of an object or a point, in a scene where objects have them.
std::string common_material(const ExportedScene& scene);

/// For each object, GlslParts::opacities. Throws std::runtime_error for a product that shaders do not read:
/// in shadows, or of several numbers of the vertices where light is not evaluated for each fragment.
std::vector<std::string> textured_opacities(const ExportedScene& scene);

/// For each object, GlslParts::normal_maps.
std::vector<std::string> normal_map_texts(const ExportedScene& scene, NormalScale normal_scale);

/// The part of GlslParts::texture that reads the pictures of materials, which needs a member `unit` of
/// ColorTexture; empty if no object has one.
std::string material_units(const ExportedScene& scene);

/// How shaders read textures; `units` declares texel_of_unit().
std::string texture_functions(const ExportedScene& scene, const std::string& units);

}  // namespace candela::target
