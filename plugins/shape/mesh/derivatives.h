// Partial derivatives of position from texture coordinates.
#pragma once

#include <cstddef>

import candela.shape;

/// Fills `mesh.dpdu` and `mesh.dpdv` of `vertices` vertices: of each, the mean over its triangles, by area,
/// of the derivatives along the texture coordinates. Zero where all its triangles have theirs on a line or a
/// point.
void derivatives_from_uv(const candela::MeshSpans& mesh, std::size_t vertices);
