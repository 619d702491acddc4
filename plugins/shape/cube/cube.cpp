#include "candela/shape_plugin.h"

using namespace candela::sdk;

namespace {

struct CubeShape {
    float size;
};

/// A cube centred on the origin. Each face has four vertices of its own, so that every shading model keeps
/// the edges sharp.
class Cube final : public candela::Shape {
  public:
    explicit Cube(const CubeShape& shape) : shape_(shape) {}

    void tessellate(const candela::MeshRequest& request, candela::MeshSink& sink) const override {
        struct Face {
            candela::Vec3 outwards, right, up;  // right x up = outwards
        };
        constexpr Face k_faces[6] = {{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}}, {{-1, 0, 0}, {0, 0, 1}, {0, 1, 0}},
                                     {{0, 1, 0}, {1, 0, 0}, {0, 0, -1}}, {{0, -1, 0}, {1, 0, 0}, {0, 0, 1}},
                                     {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}},  {{0, 0, -1}, {-1, 0, 0}, {0, 1, 0}}};
        const candela::MeshSpans mesh = sink.allocate({.vertices = 24,
                                                       .triangles = 12,
                                                       .has_uv = request.uv,
                                                       .has_derivatives = request.derivatives,
                                                       .closedness = candela::Closedness::convex});
        std::uint32_t vertex = 0;
        std::size_t corner = 0;
        for (const Face& face : k_faces) {
            for (const std::uint32_t c : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices[corner++] = vertex + c;
            for (const auto& [u, v] : {std::pair{0.0f, 0.0f}, {1.0f, 0.0f}, {1.0f, 1.0f}, {0.0f, 1.0f}}) {
                const float half = 0.5f * shape_.size;
                mesh.position.set(vertex,
                                  half * (face.outwards + (2 * u - 1) * face.right + (2 * v - 1) * face.up));
                if (request.uv) {
                    mesh.uv.x[vertex] = u;
                    mesh.uv.y[vertex] = v;
                }
                if (request.derivatives) {
                    mesh.dpdu.set(vertex, shape_.size * face.right);
                    mesh.dpdv.set(vertex, shape_.size * face.up);
                }
                ++vertex;
            }
        }
    }

  private:
    CubeShape shape_;
};

constexpr auto k_fields = fields(real(&CubeShape::size, "size", 1, "length of an edge").above(0).unit("m"));

constexpr candela::Property k_properties[] = {{"closed"}, {"euler-characteristic", "2"}};

}  // namespace

CANDELA_PLUGIN(shape, Cube, k_fields,
               {.title = "Cube",
                .summary = "A cube centred on the object's position.",
                .properties = k_properties})
