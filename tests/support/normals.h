// Polyhedra with known vertex normals, and properties that every weighting of faces must have.
#pragma once

#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

#include "support/samples.h"

/// Triangles; each vertex is its own smooth group.
struct Polyhedron {
    std::vector<candela::Vec3> position;
    std::vector<std::uint32_t> indices;

    void add(std::uint32_t a, std::uint32_t b, std::uint32_t c) { indices.insert(indices.end(), {a, b, c}); }
    std::size_t triangles() const { return indices.size() / 3; }
};

/// The unit vector; zero if the vector has no length.
Double3 unit_or_zero(Double3 v);

/// Calls a shading model like the host does: face normals by the cross product, in double precision.
std::vector<candela::Vec3> vertex_normals(const candela::ShadingModel& model, const Polyhedron& body);

/// The largest angle, in radians, between two lists of unit vectors.
double largest_angle(const std::vector<candela::Vec3>& normals, const std::vector<Double3>& expected);

/// The weight of a face at a corner, from the edges to its next and its previous corner.
using CornerWeight = std::function<double(Double3 to_next, Double3 to_previous)>;

/// Compares a model's vertex normals with the weighted sum in double precision, for meshes of k_batch_sizes
/// triangles and every instruction set; also for the mesh moved, rotated, rescaled, and with its vertices,
/// corners and triangles in another order.
void check_weighted_normals(std::string_view model, const CornerWeight& weight);

/// Checks that vertices of only degenerate triangles, or of none, get finite normals, of unit length if they
/// have any proper face; that authored normals take precedence; and that vertices of one smooth group share
/// one normal.
void check_normals_of_odd_meshes(std::string_view model);

/// Checks that light is evaluated at fragments, with the interpolated vertex normal normalised (DD10).
void check_interpolated_normals(std::string_view model);
