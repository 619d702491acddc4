#include "orientation.h"
#include "candela/parallel.h"
#include "candela/shape.h"
#include "parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

using candela::ConstVec3Span;
using candela::Vec3;

namespace mesh {

namespace {

/// Six times a part's volume, and the sum of the absolute values of its terms.
struct Volume {
    double sum = 0, size = 0;

    /// A flat part has no volume except for rounding errors.
    bool is_negative() const {
        constexpr double k_rounding = 1e-6;
        return sum < -k_rounding * size;
    }
};

/// Six times the volume of the tetrahedron between a triangle and `origin`.
double six_volumes(const mesh_io::Surface& surface, std::size_t triangle, Vec3 origin) {
    const ConstVec3Span position = surface.position.span();
    double p[3][3];
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 v = position[surface.indices[3 * triangle + k]];
        p[k][0] = double{v.x} - origin.x;
        p[k][1] = double{v.y} - origin.y;
        p[k][2] = double{v.z} - origin.z;
    }
    return p[0][0] * (p[1][1] * p[2][2] - p[1][2] * p[2][1]) -
           p[0][1] * (p[1][0] * p[2][2] - p[1][2] * p[2][0]) +
           p[0][2] * (p[1][0] * p[2][1] - p[1][1] * p[2][0]);
}

/// How far a triangle's normals lie on its front, weighted by its area.
double agreement(const mesh_io::Surface& surface, std::size_t triangle) {
    const ConstVec3Span position = surface.position.span();
    const std::uint32_t* const v = &surface.indices[3 * triangle];
    const Vec3 front = cross(position[v[1]] - position[v[0]], position[v[2]] - position[v[0]]);
    double result = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const double some = dot(front, candela::normalized(surface.normal.span()[v[k]]));
        if (std::isfinite(some)) result += some;
    }
    return result;
}

/// A surface of several parts.
class Orientation {
  public:
    Orientation(mesh_io::Surface& surface, const Corners& corners, const OpenEdges& open)
        : surface_(surface), corners_(corners), parts_(surface, corners), closed_(parts_.count(), true) {
        for (const std::uint32_t place : open.places) closed_[parts_.of_place(place)] = false;
    }

    bool turn() {
        const std::vector<Volume> volumes = volumes_of_parts();
        const auto is_negative = [&](std::size_t part) {
            return closed_[part] && volumes[part].is_negative();
        };
        std::vector<bool> is_turned(parts_.count());
        for (std::size_t part = 0; part < is_turned.size(); ++part) is_turned[part] = is_negative(part);
        if (std::ranges::none_of(is_turned, [](bool b) { return b; })) return false;
        if (parts_.count() > 1) {
            const auto containers = containers_of(surface_, corners_, parts_, closed_);
            const auto is_outermost = [&](std::size_t part) { return containers[part].empty(); };
            for (std::size_t part = 0; part < is_turned.size(); ++part)
                is_turned[part] = is_outermost(part)
                                      ? is_negative(part)
                                      : std::ranges::any_of(containers[part], [&](std::uint32_t outer) {
                                            return is_outermost(outer) && is_negative(outer);
                                        });
        }
        const auto count = static_cast<std::size_t>(std::ranges::count(is_turned, true));
        if (count == 0) return false;
        turn_triangles(is_turned);
        turn_normals(is_turned);
        surface_.notes.push_back(
            count == parts_.count()
                ? "is closed but wound inside out, so its triangles are turned round"
                : fmt::format("has {} parts, {} of which {} closed but wound inside out, so {} triangles are "
                              "turned round",
                              parts_.count(), count, count == 1 ? "is" : "are",
                              count == 1 ? "its" : "their"));
        return true;
    }

  private:
    std::uint32_t part_of(std::size_t triangle) const {
        return parts_.of_place(corners_.place(part_vertex_of(triangle)));
    }
    std::uint32_t part_vertex_of(std::size_t triangle) const { return surface_.indices[3 * triangle]; }

    /// Summed in an order that does not depend on the threads.
    std::vector<Volume> volumes_of_parts() const {
        std::vector<Vec3> origin(parts_.count());
        std::vector<bool> has_origin(parts_.count());
        std::vector<Volume> volumes(parts_.count());
        if (parts_.count() == 1) {
            const Vec3 first = surface_.position.span()[surface_.indices[0]];
            std::vector<Volume> partial((surface_.triangles() + k_per_task - 1) / k_per_task);
            candela::parallel_for(partial.size(), 1, [&](std::size_t begin, std::size_t end) {
                for (std::size_t block = begin; block < end; ++block)
                    for (std::size_t t = block * k_per_task;
                         t < std::min((block + 1) * k_per_task, surface_.triangles()); ++t)
                        add(partial[block], six_volumes(surface_, t, first));
            });
            for (const Volume& some : partial) {
                volumes[0].sum += some.sum;
                volumes[0].size += some.size;
            }
            return volumes;
        }
        for (std::size_t t = 0; t < surface_.triangles(); ++t) {
            const std::uint32_t part = part_of(t);
            if (!has_origin[part]) origin[part] = surface_.position.span()[part_vertex_of(t)];
            has_origin[part] = true;
            add(volumes[part], six_volumes(surface_, t, origin[part]));
        }
        return volumes;
    }
    static void add(Volume& volume, double some) {
        volume.sum += some;
        volume.size += std::abs(some);
    }

    void turn_triangles(const std::vector<bool>& is_turned) {
        candela::parallel_for(surface_.triangles(), k_per_task, [&](std::size_t begin, std::size_t end) {
            for (std::size_t t = begin; t < end; ++t) {
                if (!is_turned[part_of(t)]) continue;
                std::swap(surface_.indices[3 * t + 1], surface_.indices[3 * t + 2]);
                if (!surface_.facet_normal.empty())
                    surface_.facet_normal.span().set(t, -surface_.facet_normal.span()[t]);
            }
        });
    }

    void turn_normals(const std::vector<bool>& is_turned) {
        if (surface_.normal.empty()) return;
        std::vector<double> agreements(parts_.count());
        for (std::size_t t = 0; t < surface_.triangles(); ++t)
            if (const std::uint32_t part = part_of(t); is_turned[part])
                agreements[part] += agreement(surface_, t);
        for (std::uint32_t i = 0; i < surface_.normal.size(); ++i) {
            // A place that no triangle uses belongs to no part.
            const std::uint32_t place = corners_.place(i);
            if (corners_.at(place).empty() || agreements[parts_.of_place(place)] >= 0) continue;
            surface_.normal.span().set(i, -surface_.normal.span()[i]);
            if (!surface_.tangent_side.empty()) surface_.tangent_side[i] = -surface_.tangent_side[i];
        }
    }

    mesh_io::Surface& surface_;
    const Corners& corners_;
    ConnectedComponents parts_;
    std::vector<bool> closed_;  // per part
};

}  // namespace

bool turn_outwards(mesh_io::Surface& surface, const Corners& corners, const OpenEdges& open) {
    return !surface.indices.empty() && Orientation(surface, corners, open).turn();
}

}  // namespace mesh
