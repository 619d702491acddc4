// Colours and opacities that an object's vertices give.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "candela/target.h"

namespace candela::povray_target {

/// The values of each vertex; empty arrays if the vertices do not give them. POV-Ray gives each vertex a
/// texture, and interpolates what they reflect and let through.
struct VertexValues {
    std::vector<Vec3> colors;  // multiply the object's
    std::vector<float> opacities;

    bool empty() const { return colors.empty() && opacities.empty(); }
};

/// `mesh`: of the object.
VertexValues vertex_values_of(const ExportedScene& scene, std::size_t object, const ExportedMesh& mesh,
                              FileSink& files);

/// Whether numbers come from pictures.
bool are_of_pictures(std::span<const ExportedTexturedNumber> numbers);

}  // namespace candela::povray_target
