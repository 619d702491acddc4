// Triangles for tests, without a scene.
#pragma once

#include <span>

#include "support/plugins.h"

import candela.api;
import candela.geometry;

/// A shape's triangles, each with the normal of its own.
candela::Mesh flat_mesh(const char* shape, Given given = {}, const candela::Transform& transform = {});

/// Triangles that share no corners, three corners each, within `bounds`.
candela::Mesh loose_triangles(std::span<const candela::Vec3> corners, const candela::Box& bounds);
