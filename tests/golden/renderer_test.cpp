// Data cached from one picture speed up the next, and never change it.
#include <unistd.h>
#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <cstdint>
#include <fstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "support/compiled.h"
#include "support/plugins.h"

namespace {

constexpr const char* k_scene = R"(version = 1
[observer]
position = [0.3, 1.6, 4.2]
look_at = [0, 0, 0]
[image]
width = 203
height = 131
background = [20, 30, 40]
[[light]]
type = "point"
position = [-2, 3, 3]
intensity = 14
[[light]]
type = "ambient"
color = [60, 60, 80]
[[object]]
type = "sphere"
position = [-1.2, 0, 0]
shading = "flat"
reflection = "phong"
[[object]]
type = "torus"
position = [0.9, -0.2, 0.6]
rotation = [30, 0, 0]
shading = "gouraud"
reflection = "lambert"
[[object]]
type = "teapot"
position = [0.2, 0.1, -1.2]
segments = 4
shading = "phong"
reflection = "blinn-phong"
)";

using Bytes = std::vector<std::uint8_t>;

class Fixture {
  public:
    explicit Fixture(const std::string& text) : Fixture(compiled(text)) {}

    template <class Render>
    Bytes picture(Render render) const {
        candela::Film film(scene.image.width, scene.image.height, candela::PixelType::byte,
                           scene.image.color_management);
        statistics_ = render(film);
        const auto bytes = film.view().bytes;
        return {bytes.begin(), bytes.end()};
    }
    Bytes from_scratch() const {
        return picture([&](candela::Film& film) { return candela::render(scene, film, {}); });
    }
    Bytes by(candela::Renderer& renderer) const {
        return picture([&](candela::Film& film) { return renderer.render(scene, film, {}); });
    }
    /// Compares without printing pictures.
    void require_same(candela::Renderer& renderer) const {
        const bool is_same = by(renderer) == from_scratch();
        REQUIRE(is_same);
    }

    const candela::RenderStatistics& statistics() const { return statistics_; }
    const candela::Scene& source() const { return source_; }

    candela::RenderScene scene;

  private:
    explicit Fixture(Compiled compiled)
        : scene(std::move(compiled.scene)), source_(std::move(compiled.source)) {}

    candela::Scene source_;
    mutable candela::RenderStatistics statistics_;
};

}  // namespace

TEST_CASE(
    "a picture from cached visibility equals one rendered from scratch, whatever changed about the light") {
    for (const int samples : {1, 4}) {
        Fixture fixture(k_scene);
        fixture.scene.image.samples = samples;
        candela::Renderer renderer(candela::Renderer::Keep::visibility);
        const Bytes first = fixture.by(renderer);
        const std::size_t pixels = fixture.statistics().pixels_shaded;
        fixture.require_same(renderer);
        CHECK(fixture.statistics().pixels_shaded == pixels);

        fixture.scene.objects[0].surface.color = {0.1f, 0.9f, 0.2f};
        fixture.require_same(renderer);
        candela::Model dimmer = fixture.source().lights[0].model;
        dimmer.parameters.set("intensity", 3.0);
        fixture.scene.lights[0] =
            candela::render_light(test_registry(), dimmer, candela::ColorEncoding::srgb);
        fixture.require_same(renderer);
        fixture.scene.objects[2].surface.set_reflection(
            test_registry(),
            {"half-lambert", test_registry().parameters(candela::PluginKind::reflection, "half-lambert")},
            candela::ColorEncoding::srgb);
        fixture.require_same(renderer);
        // Visibility does not depend on where light is evaluated either.
        fixture.scene.objects[0].surface.set_shading(
            test_registry(), {"phong", test_registry().parameters(candela::PluginKind::shading, "phong")},
            candela::ColorEncoding::srgb);
        fixture.require_same(renderer);
        const bool is_other = fixture.by(renderer) != first;
        CHECK(is_other);
    }
}

TEST_CASE("the cache is not used if the observer, the samples, the size or the objects differ") {
    Fixture fixture(k_scene);
    candela::Renderer renderer(candela::Renderer::Keep::visibility);
    fixture.require_same(renderer);
    fixture.scene.observer.position.x += 0.4f;
    fixture.require_same(renderer);
    fixture.scene.image.samples = 4;
    fixture.require_same(renderer);
    fixture.scene.image.width = 97;
    fixture.require_same(renderer);
    fixture.scene.objects.pop_back();
    fixture.require_same(renderer);
    fixture.scene.objects.clear();
    fixture.require_same(renderer);
}

TEST_CASE("a mesh changed in place is visible once visibility is cleared") {
    Fixture fixture(k_scene);
    candela::Renderer renderer(candela::Renderer::Keep::visibility);
    fixture.require_same(renderer);
    for (float& y : fixture.scene.objects[0].mesh.position.y) y += 0.3f;
    renderer.forget();
    fixture.require_same(renderer);
}

TEST_CASE("a failed picture does not count as cached") {
    Fixture fixture(k_scene);
    candela::Renderer renderer(candela::Renderer::Keep::visibility);
    candela::Film film(fixture.scene.image.width, fixture.scene.image.height, candela::PixelType::byte,
                       fixture.scene.image.color_management);
    const auto stop = [](std::size_t, std::size_t) { throw std::runtime_error("enough"); };
    CHECK_THROWS(renderer.render(fixture.scene, film, {.threads = 1, .progress = stop}));
    fixture.require_same(renderer);
}

// A sanitizer deliberately holds back memory.
#if !__has_feature(address_sanitizer) && !__has_feature(thread_sanitizer)
namespace {

/// The memory that this process holds, in bytes.
std::size_t resident() {
    std::ifstream statm("/proc/self/statm");
    std::size_t all = 0, in_memory = 0;
    statm >> all >> in_memory;
    return in_memory * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

}  // namespace

TEST_CASE("the thousandth picture holds no more memory than the hundredth", "[whole]") {
    Fixture fixture(k_scene);
    candela::Renderer renderer(candela::Renderer::Keep::visibility);
    const auto render = [&](int pictures) {
        for (int i = 0; i < pictures; ++i) {
            fixture.scene.observer.position.x = 0.3f + 0.01f * static_cast<float>(i % 7);
            fixture.by(renderer);  // visibility computed again
            fixture.by(renderer);  // lit again
            fixture.from_scratch();
        }
    };
    render(100);
    const std::size_t before = resident();
    render(9000);
    INFO(before << " bytes, then " << resident());
    CHECK(resident() < before + (std::size_t{1} << 20));
}
#endif
