// The points of surfaces, and the light that arrives there, that plugins are given in batches.
#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "arrays.h"

import candela.api;

/// The positions of the inputs among the arrays, for all kinds: three arrays each.
namespace inputs {
inline constexpr std::size_t k_normal = 0;    // N
inline constexpr std::size_t k_observer = 3;  // V
inline constexpr std::size_t k_tangent = 6;
inline constexpr std::size_t k_light = 9;     // L
inline constexpr std::size_t k_diffuse = 12;  // intensities
inline constexpr std::size_t k_specular = 15;
inline constexpr std::size_t k_position = 18;
inline constexpr std::size_t k_barycentric = 21;
inline constexpr std::size_t k_vertex_normal = 24;
inline constexpr std::size_t k_dpdu = 27;
inline constexpr std::size_t k_dpdv = 30;
inline constexpr std::size_t k_uv = 33;                // two
inline constexpr std::size_t k_corner_positions = 35;  // the triangle's: three vectors
inline constexpr std::size_t k_corner_normals = 44;    // also three vectors
inline constexpr std::size_t k_color = 53;             // C_o
inline constexpr std::size_t k_inputs = 56;
}  // namespace inputs

/// Lights as data, and an observer, around which inputs_for() places its points: a point light, an infinitely
/// distant one, and a spot light.
const candela::PunctualLighting& punctual_lighting();

/// Inputs as a renderer provides them, equal for equal `seed`: unit vectors, positions, colours.
Arrays inputs_for(std::size_t count, unsigned seed = 1);
/// Gives point `i` a triangle around its position, in the plane of its face normal, of about one metre.
void put_triangle(Arrays& in, std::size_t i, const std::array<candela::Vec3, 3>& normals);
/// Inputs whose vectors coincide, oppose each other or are orthogonal: V = N, L = V, a vertex normal that is
/// the face normal …
Arrays aligned_inputs();
/// The same inputs in a rotated world: all vectors and triangles are rotated, positions are not.
Arrays turned(const Arrays& in);
candela::Vec3 turned(candela::Vec3 v);

/// "N = [0, 1, 0], …": an input, for messages.
std::string text_of_input(const Arrays& in, std::size_t i);
