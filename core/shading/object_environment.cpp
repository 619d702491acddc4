module;

#include <algorithm>
#include <cstddef>
#include <utility>

module candela.shading;

import :object_environment;

namespace candela {

void ObjectEnvironment::look(std::size_t count, const ConstVec3Span& towards, const Vec3Span& intensity) {
    environment_.look(count, towards, intensity);
}

void ObjectEnvironment::trace_exit(std::size_t count, const ConstVec3Span& origin,
                                   const ConstVec3Span& direction, const ExitBatch& exit) {
    for (std::size_t first = 0; first < count; first += k_batch_size) {
        leave_batch(std::min(k_batch_size, count - first), origin.from(first), direction.from(first),
                    {exit.position.from(first), exit.normal.from(first), exit.distance + first});
    }
}

void ObjectEnvironment::leave_batch(std::size_t count, const ConstVec3Span& origin,
                                    const ConstVec3Span& direction, const ExitBatch& exit) {
    triangles_.assign(count, 0);
    barycentric_.resize(k_batch_size);
    normal_.resize(k_batch_size);
    if (object_.tree != nullptr) {
        object_.tree->find_exits(count, origin, direction,
                                 {triangles_.data(), exit.distance, barycentric_.span()});
    } else {
        std::fill_n(exit.distance, count, -1.0f);
    }
    PointNeeds needs = surface_->needs();
    needs.color = false;
    needs.footprint = surface_->material_textures.normal.has_value();
    gather_places(*object_.mesh, triangles_, std::as_const(barycentric_).span(), needs, points_);
    // Into an array with room for a whole batch, as everywhere: not all plugins respect the end of their
    // batch.
    shading_normals(*surface_, points_, normal_.span());
    if (surface_->material_textures.normal) {
        apply_textures(*surface_, points_);
        tilt_normals(*surface_, points_, normal_.span());
    }
    const ConstVec3Span position = std::as_const(points_).position.span(),
                        normal = std::as_const(normal_).span();
    for (std::size_t i = 0; i < count; ++i) {
        const bool leaves = exit.distance[i] >= 0;
        exit.position.set(i, leaves ? position[i] : origin[i]);
        exit.normal.set(i, leaves ? normal[i] : direction[i]);
    }
}

}  // namespace candela
