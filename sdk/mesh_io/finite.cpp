#include "mesh_io/finite.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>

using candela::Vec3;

namespace mesh_io {

namespace {

/// A loop that compilers vectorise: the product is NaN if any value is not finite.
bool are_finite(const Array<float>& values) {
    constexpr std::size_t k_lanes = 16;
    std::array<float, k_lanes> sum{};
    std::size_t i = 0;
    for (; i + k_lanes <= values.size(); i += k_lanes)
        for (std::size_t k = 0; k < k_lanes; ++k) sum[k] += 0 * values[i + k];
    for (; i < values.size(); ++i) sum[0] += 0 * values[i];
    return std::ranges::all_of(sum, [](float x) { return x == 0; });
}

bool are_finite(const Vectors& v) { return are_finite(v.x) && are_finite(v.y) && are_finite(v.z); }

bool is_finite(Vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

void require_finite_positions(Surface& surface, std::string_view face) {
    const candela::Vec3Span position = surface.position.span();
    for (const std::uint32_t index : surface.indices) {
        const Vec3 p = position[index];
        if (!is_finite(p))
            throw BadFile(
                fmt::format("has a {} with the corner [{:g}, {:g}, {:g}] (vertex {}, counted from 0); "
                            "positions must be finite",
                            face, p.x, p.y, p.z, index));
    }
    const Vec3 some = surface.indices.empty() ? Vec3{} : position[surface.indices[0]];
    for (std::size_t i = 0; i < surface.position.size(); ++i)
        if (!is_finite(position[i])) position.set(i, some);
}

}  // namespace

void require_finite(Surface& surface, std::string_view face) {
    if (!are_finite(surface.position)) require_finite_positions(surface, face);
    for (Vectors* const normals : {&surface.normal, &surface.facet_normal}) {
        if (are_finite(*normals)) continue;
        std::uint64_t count = 0;
        for (std::size_t i = 0; i < normals->size(); ++i) {
            if (is_finite(normals->span()[i])) continue;
            normals->span().set(i, {});
            ++count;
        }
        surface.notes.push_back(fmt::format("has {} that {} not finite; computed ones are used instead",
                                            counted(count, "normal"), count == 1 ? "is" : "are"));
    }
    if (are_finite(surface.u) && are_finite(surface.v)) return;
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < surface.u.size(); ++i) {
        if (std::isfinite(surface.u[i]) && std::isfinite(surface.v[i])) continue;
        surface.u[i] = surface.v[i] = 0;
        ++count;
    }
    surface.notes.push_back(fmt::format("has {} that are not finite; zeros are used instead",
                                        counted(count, "pair") + " of texture coordinates"));
}

}  // namespace mesh_io
