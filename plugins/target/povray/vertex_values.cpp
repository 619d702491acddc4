#include "vertex_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>

#include "candela/target/textures.h"

namespace candela::povray_target {

namespace {

/// A number at each vertex, within its range.
std::vector<float> values_of(const ExportedTexturedNumber& number, const ExportedMesh& mesh) {
    std::vector<float> values;
    values.reserve(mesh.vertex_count);
    for (const float given : mesh.channels[number.vertex_channel])
        values.push_back(target::value_of(number, given));
    return values;
}

bool differ(std::span<const Vec3> colors) {
    return std::ranges::any_of(colors, [&](Vec3 color) {
        return color.x != colors[0].x || color.y != colors[0].y || color.z != colors[0].z;
    });
}

}  // namespace

bool are_of_pictures(std::span<const ExportedTexturedNumber> numbers) {
    return !numbers.empty() && !target::is_of_vertices(numbers.front());
}

VertexValues vertex_values_of(const ExportedScene& scene, std::size_t object, const ExportedMesh& mesh,
                              FileSink& files) {
    const ExportedObject& of = scene.objects[object];
    VertexValues result;
    std::size_t factors = 0;  // that vary from vertex to vertex
    if (are_of_pictures(of.color_numbers)) {
        if (mesh.color)
            files.approximate("the colours at the vertices of objects with a texture are left out");
    } else if (mesh.color || !of.color_numbers.empty()) {
        result.colors.assign(mesh.vertex_count, {1, 1, 1});
        for (std::size_t v = 0; mesh.color && v < mesh.vertex_count; ++v) result.colors[v] = mesh.color[v];
        factors += mesh.color && differ(result.colors) ? 1 : 0;
        if (!of.color_numbers.empty()) {
            std::array<std::vector<float>, 3> channels;
            for (const ExportedTexturedNumber& number : of.color_numbers)
                channels[number.channel] = values_of(number, mesh);
            for (std::size_t v = 0; v < mesh.vertex_count; ++v) {
                Vec3& color = result.colors[v];
                color = {color.x * channels[0][v], color.y * channels[1][v], color.z * channels[2][v]};
            }
            ++factors;
        }
    }
    for (const ExportedTexturedNumber& number : of.opacity_numbers) {
        if (!target::is_of_vertices(number)) continue;
        const std::vector<float> values = values_of(number, mesh);
        if (result.opacities.empty()) result.opacities.assign(mesh.vertex_count, 1);
        for (std::size_t v = 0; v < values.size(); ++v) result.opacities[v] *= values[v];
        ++factors;
    }
    if (factors > 1)
        files.approximate(
            fmt::format("the product of numbers at the vertices of object {} is interpolated between them",
                        of.label)
                .c_str());
    if (of.opacity_cutoff > 0 && !result.opacities.empty())
        files.approximate(
            fmt::format("the opacity at the vertices of object {} is cut off there, not between them",
                        of.label)
                .c_str());
    return result;
}

}  // namespace candela::povray_target
