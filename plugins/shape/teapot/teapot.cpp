#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "candela/shape_plugin.h"
#include "patches.h"

using namespace candela::sdk;

namespace {

using candela::Vec3;

struct TeapotShape {
    float size;
    std::int32_t segments;
};

using Weights = std::array<float, 4>;

/// Cubic Bernstein polynomials; exactly 0 and 1 at the ends, so that patches that share a boundary meet
/// exactly.
Weights bernstein(float t) {
    const float s = 1 - t;
    return {s * s * s, 3 * t * s * s, 3 * t * t * s, t * t * t};
}
Weights bernstein_derivative(float t) {
    const float s = 1 - t;
    return {-3 * s * s, 3 * s * (1 - 3 * t), 3 * t * (2 - 3 * t), 3 * t * t};
}

using Points = std::array<Vec3, 4>;

Vec3 combine(const Points& points, const Weights& weights) {
    Vec3 sum;
    for (std::size_t i = 0; i < 4; ++i) sum = sum + weights[i] * points[i];
    return sum;
}

/// The patch's point or derivative, depending on the weights.
Vec3 blend(const teapot::Patch& patch, const Weights& u, const Weights& v) {
    return combine({combine(patch[0], u), combine(patch[1], u), combine(patch[2], u), combine(patch[3], u)},
                   v);
}

/// The patch's point; if a row of control points coincides, exactly that point.
Vec3 point(const teapot::Patch& patch, float u, float v) {
    const Weights weights = bernstein(u);
    const auto row = [&](const Points& p) {
        return p[0] == p[1] && p[1] == p[2] && p[2] == p[3] ? p[0] : combine(p, weights);
    };
    return combine({row(patch[0]), row(patch[1]), row(patch[2]), row(patch[3])}, bernstein(v));
}

class Teapot final : public candela::Shape {
  public:
    explicit Teapot(const TeapotShape& shape) : shape_(shape) {}

    void tessellate(const candela::MeshRequest& request, candela::MeshSink& sink) const override {
        const std::vector<teapot::Patch> patches = teapot::patches();
        const auto n = static_cast<std::size_t>(shape_.segments);
        const std::size_t width = n + 1;
        const float scale = shape_.size / teapot::k_height;

        // Where a patch ends in a point, one of two triangles has no area; which one is only known once the
        // vertices are.
        std::vector<Vec3> position;
        position.reserve(patches.size() * width * width);
        for (const teapot::Patch& patch : patches) {
            for (std::size_t i = 0; i < width * width; ++i) {
                const auto [u, v] = parameters(i);
                const Vec3 p = point(patch, u, v);
                position.push_back(scale * Vec3{p.x, p.y - 0.5f * teapot::k_height, p.z});
            }
        }
        std::vector<std::uint32_t> indices;
        const auto triangle = [&](std::size_t a, std::size_t b, std::size_t c) {
            if (position[a] == position[b] || position[b] == position[c] || position[c] == position[a])
                return;
            for (const std::size_t vertex : {a, b, c}) indices.push_back(static_cast<std::uint32_t>(vertex));
        };
        for (std::size_t p = 0; p < patches.size(); ++p) {
            for (std::size_t row = 0; row < n; ++row) {
                for (std::size_t column = 0; column < n; ++column) {
                    const std::size_t a = (p * width + row) * width + column;
                    triangle(a, a + 1, a + 1 + width);
                    triangle(a, a + 1 + width, a + width);
                }
            }
        }

        const candela::MeshSpans mesh = sink.allocate({.vertices = position.size(),
                                                       .triangles = indices.size() / 3,
                                                       .has_uv = request.uv,
                                                       .has_derivatives = request.derivatives,
                                                       .has_smooth_groups = true,
                                                       .closedness = candela::Closedness::open});
        std::ranges::copy(indices, mesh.indices.begin());
        std::size_t i = 0;
        for (const teapot::Patch& patch : patches) {
            for (std::size_t vertex = 0; vertex < width * width; ++vertex, ++i) {
                const auto [u, v] = parameters(vertex);
                mesh.position.set(i, position[i]);
                if (request.uv) {
                    mesh.uv.x[i] = u;
                    mesh.uv.y[i] = v;
                }
                if (request.derivatives) {
                    mesh.dpdu.set(i, scale * blend(patch, bernstein_derivative(u), bernstein(v)));
                    mesh.dpdv.set(i, scale * blend(patch, bernstein(u), bernstein_derivative(v)));
                }
            }
        }
        // One normal per position: smooth across the seams of the patches.
        weld_by_position(mesh.position, position.size(), mesh.smooth_group);
    }

  private:
    std::pair<float, float> parameters(std::size_t vertex) const {
        const std::size_t width = static_cast<std::size_t>(shape_.segments) + 1;
        const std::size_t row = vertex / width;
        const std::size_t column = vertex % width;
        const auto last = static_cast<float>(shape_.segments);
        return {static_cast<float>(column) / last, static_cast<float>(row) / last};
    }

    TeapotShape shape_;
};

constexpr auto k_fields =
    fields(real(&TeapotShape::size, "size", 1, "height, from the bottom to the knob").above(0).unit("m"),
           integer(&TeapotShape::segments, "segments", 10, "faces along each edge of the 32 patches")
               .range(1, 1024));

constexpr candela::Property k_properties[] = {{"open"}};

}  // namespace

CANDELA_PLUGIN(
    shape, Teapot, k_fields,
    {.title = "Teapot",
     .summary =
         "Newell's teapot, centred on its axis at half its height, with the spout along +x; not closed.",
     .formula = "p(u, v) = sum B_i(u) B_j(v) P_ij  over 32 bicubic Bezier patches",
     .reference = "Newell (1975), The utilization of procedure models in digital image synthesis, "
                  "University of Utah",
     .properties = k_properties})
