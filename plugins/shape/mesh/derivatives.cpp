#include "derivatives.h"
#include "candela/math.h"

#include <array>
#include <cmath>
#include <vector>

using candela::Vec3;

namespace {

struct Derivatives {
    Vec3 du, dv;
};

/// For a triangle with edges `p` and `q` along which the texture coordinates change by (pu, pv) and (qu, qv).
Derivatives of_triangle(Vec3 p, Vec3 q, float pu, float pv, float qu, float qv) {
    const float scale = 1 / (pu * qv - qu * pv);
    return {scale * (qv * p - pv * q), scale * (pu * q - qu * p)};
}

bool is_finite(const Derivatives& d) {
    return std::isfinite(dot(d.du, d.du)) && std::isfinite(dot(d.dv, d.dv));
}

}  // namespace

void derivatives_from_uv(const candela::MeshSpans& mesh, std::size_t vertices) {
    std::vector<float> area(vertices);
    for (std::size_t corner = 0; corner + 2 < mesh.indices.size(); corner += 3) {
        const std::array<std::size_t, 3> v = {mesh.indices[corner], mesh.indices[corner + 1],
                                              mesh.indices[corner + 2]};
        const auto along = [&](const float* a, std::size_t k) { return a[v[k]] - a[v[0]]; };
        const Vec3 p = mesh.position[v[1]] - mesh.position[v[0]];
        const Vec3 q = mesh.position[v[2]] - mesh.position[v[0]];
        const Derivatives d = of_triangle(p, q, along(mesh.uv.x, 1), along(mesh.uv.y, 1), along(mesh.uv.x, 2),
                                          along(mesh.uv.y, 2));
        const float weight = length(cross(p, q));
        if (!is_finite(d) || !std::isfinite(weight)) continue;
        for (const std::size_t i : v) {
            const float sum = area[i] + weight;
            const float share = sum > 0 ? weight / sum : 0.0f;
            mesh.dpdu.set(i, (1 - share) * mesh.dpdu[i] + share * d.du);
            mesh.dpdv.set(i, (1 - share) * mesh.dpdv[i] + share * d.dv);
            area[i] = sum;
        }
    }
}
