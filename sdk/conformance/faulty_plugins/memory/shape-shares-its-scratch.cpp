// Between its two loops, another thread may write to the memory that all threads share.
#include "candela/shape_plugin.h"

#include <algorithm>
#include <array>

namespace {
struct Params {
    float height = 1;
};
constexpr auto k_fields = candela::sdk::fields(
    candela::sdk::real(&Params::height, "height", 1, "of its tip").above(0).maximum(10).unit("m"));

constexpr std::size_t k_sides = 4096;
std::array<candela::Vec3, k_sides> scratch;

class Fan final : public candela::Shape {
  public:
    explicit Fan(const Params& params) : height_(params.height) {}
    void tessellate(const candela::MeshRequest&, candela::MeshSink& sink) const override {
        for (std::size_t i = 0; i < k_sides; ++i) {
            const float x = static_cast<float>(i) / k_sides;
            scratch[i] = {x, height_ * x * x, 0};
        }
        const candela::MeshSpans mesh = sink.allocate({.vertices = k_sides + 1, .triangles = k_sides - 1});
        mesh.position.set(k_sides, {0, 0, 1});
        for (std::size_t i = 0; i < k_sides; ++i) mesh.position.set(i, scratch[i]);
        for (std::uint32_t i = 0; i + 1 < k_sides; ++i)
            std::ranges::copy(std::array<std::uint32_t, 3>{i, i + 1, k_sides}, mesh.indices.begin() + 3 * i);
    }

  private:
    float height_;
};
}  // namespace

CANDELA_PLUGIN(shape, Fan, k_fields, {.title = "Fan", .summary = "Bad on purpose."})
