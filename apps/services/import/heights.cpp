#include "import/heights.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <exception>
#include <filesystem>
#include <new>
#include <optional>

#include "import/vectors.h"

import candela.api;
import candela.geometry;
import candela.plugins;

namespace importing {

namespace {

/// Areas of triangles in space and in texture coordinates.
struct Areas {
    double space = 0, texture = 0;

    void add(const candela::Mesh& mesh) {
        if (mesh.u.empty()) return;
        for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
            const auto corner = [&](std::size_t k) {
                const candela::Vec3 p = mesh.position.span()[mesh.indices[3 * t + k]];
                return Vector{p.x, p.y, p.z};
            };
            const auto in_texture = [&](std::size_t k) {
                const std::size_t i = mesh.indices[3 * t + k];
                return Vector{mesh.u[i], mesh.v[i], 0};
            };
            const double in_space = length(cross(corner(1) - corner(0), corner(2) - corner(0)));
            const double flat = length(cross(in_texture(1) - in_texture(0), in_texture(2) - in_texture(0)));
            if (!std::isfinite(in_space + flat)) continue;
            space += in_space;
            texture += flat;
        }
    }
};

/// Areas of the parts that have a material.
Areas areas_of(std::size_t material, const Model& model, const Geometry& geometry,
               candela::ParamSet parameters, candela::Registry& registry) {
    Areas areas;
    for (const Part& part : model.parts) {
        if (part.material != material) continue;
        if (part.selector.empty()) {
            areas.add(geometry.mesh);
            continue;
        }
        parameters.set("part", part.selector);
        try {
            const auto shape =
                registry.create<candela::Shape>("mesh", parameters, candela::ColorEncoding::srgb);
            areas.add(candela::place(*shape, {.uv = true, .normals = false}, {}).mesh);
        } catch (const std::bad_alloc&) {
            throw;
        } catch (const std::exception&) {
            continue;  // reported when the scene is read
        }
    }
    return areas;
}

}  // namespace

void measure_heights(Model& model, const Source& source, const Geometry& geometry,
                     candela::Registry& registry) {
    candela::ParamSet parameters = registry.parameters(candela::PluginKind::shape, "mesh");
    parameters.set("file", std::filesystem::absolute(source.file).string());
    parameters.set("allow_outside", source.allows_outside);
    if (!geometry.origin.empty()) parameters.set("origin", geometry.origin);
    for (std::size_t i = 0; i < model.materials.size(); ++i) {
        Material& material = model.materials[i];
        if (!material.normals || !material.has_heights) continue;
        const Areas areas = areas_of(i, model, geometry, parameters, registry);
        constexpr double k_share = 0.01;
        const Placing& placing = material.normals->placing;
        const double side =
            std::sqrt(areas.space / (areas.texture * std::abs(placing.scale[0] * placing.scale[1])));
        double& height = material.normals->scale[0];
        height *= k_share * side;
        if (height == 0 || !std::isfinite(height)) material.normals.reset();
    }
}

}  // namespace importing
