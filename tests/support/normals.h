// Polyhedra whose vertex normals are wanted, and what must hold of every way to weigh their faces.
#pragma once

#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

#include "support/samples.h"

/// Triangles; a vertex each is a smooth group of its own.
struct Polyhedron {
    std::vector<candela::Vec3> position;
    std::vector<std::uint32_t> indices;

    void add(std::uint32_t a, std::uint32_t b, std::uint32_t c) { indices.insert(indices.end(), {a, b, c}); }
    std::size_t triangles() const { return indices.size() / 3; }
};

/// The unit vector, or zero of a vector without length.
Double3 unit_or_zero(Double3 v);

/// What the host asks of a shading model: face normals by the cross product, in double precision.
std::vector<candela::Vec3> vertex_normals(const candela::ShadingModel& model, const Polyhedron& body);

/// The largest angle, in radians, between two lists of unit vectors.
double largest_angle(const std::vector<candela::Vec3>& normals, const std::vector<Double3>& expected);

/// The weight of a face at a corner, from the edges to its next and its previous corner.
using CornerWeight = std::function<double(Double3 to_next, Double3 to_previous)>;

/// Compares a model's vertex normals with the weighted sum in double precision, for meshes of k_batch_sizes
/// triangles and every instruction set; and the same mesh moved and turned, of other sizes, and with its
/// vertices, corners and triangles in another order.
void check_weighted_normals(std::string_view model, const CornerWeight& weight);

/// Triangles without area, and vertices that have no others, must leave finite normals, unit where there is
/// any face; authored normals go before all; and vertices of one smooth group share one normal.
void check_normals_of_odd_meshes(std::string_view model);

/// Whether light is evaluated at fragments, with the interpolated vertex normal normalised (DD10).
void check_interpolated_normals(std::string_view model);
