// Partial derivatives of position with respect to texture coordinates.
#pragma once

#include <cstddef>

#include "candela/shape.h"

/// Fills `mesh.dpdu` and `mesh.dpdv` for `vertices` vertices, with the area-weighted mean over each vertex's
/// triangles of the derivatives with respect to the texture coordinates. Zero if the texture coordinates of
/// all its triangles are collinear or coincide.
void derivatives_from_uv(const candela::MeshSpans& mesh, std::size_t vertices);
