module;

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

module candela.shade;

import :surroundings;

namespace candela {

void ObjectSurroundings::look(std::size_t count, const ConstVec3Span& towards, const Vec3Span& intensity) {
    environment_.look(count, towards, intensity);
}

void ObjectSurroundings::leave(std::size_t count, const ConstVec3Span& origin, const ConstVec3Span& direction,
                               const ExitBatch& exit) {
    barycentric_.resize(k_batch_size);
    normal_.resize(k_batch_size);
    for (std::size_t first = 0; first < count; first += k_batch_size) {
        leave_batch(std::min(k_batch_size, count - first), origin.from(first), direction.from(first),
                    {exit.position.from(first), exit.normal.from(first), exit.distance + first});
    }
}

void ObjectSurroundings::leave_batch(std::size_t count, const ConstVec3Span& origin,
                                     const ConstVec3Span& direction, const ExitBatch& exit) {
    triangles_.clear();
    rays_.clear();
    exits_.resize(count);
    if (interior_.tree != nullptr) {
        interior_.tree->find_exits(origin, direction, exits_);
    } else {
        std::ranges::fill(exits_, std::nullopt);
    }
    for (std::size_t i = 0; i < count; ++i) {
        const std::optional<RayExit>& found = exits_[i];
        exit.distance[i] = found ? found->distance : -1;
        if (!found) {
            exit.position.set(i, origin[i]);
            exit.normal.set(i, direction[i]);
            continue;
        }
        barycentric_.span().set(triangles_.size(), found->barycentric);
        triangles_.push_back(found->triangle);
        rays_.push_back(static_cast<std::uint32_t>(i));
    }
    if (triangles_.empty()) return;
    PointNeeds needs = surface_->needs();
    needs.color = needs.footprint = false;
    gather_places(*interior_.mesh, triangles_, std::as_const(barycentric_).span(), needs, points_);
    shading_normals(*surface_, points_, normal_.span());
    for (std::size_t i = 0; i < rays_.size(); ++i) {
        exit.position.set(rays_[i], points_.position.span()[i]);
        exit.normal.set(rays_[i], normal_.span()[i]);
    }
}

}  // namespace candela
