// The models reflection/metallic-roughness and reflection/specular-glossiness in glTF, which has all of their
// parameters.
#pragma once

#include <optional>

#include "candela/math.h"
#include "candela/target.h"
#include "document.h"

namespace candela::gltf_target {

/// The material of a surface of that base colour, with the extensions that it needs; nothing for other
/// models.
std::optional<Json> metallic_roughness_material(const ExportedReflection& model, const ExportedValues& values,
                                                Vec3 color, Document& document);

/// Whether the highlights of a material follow the tangents of the surface.
bool is_anisotropic(const ExportedReflection& model, const ExportedValues& values);

}  // namespace candela::gltf_target
