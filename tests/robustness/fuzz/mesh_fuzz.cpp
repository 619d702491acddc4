// Arbitrary bytes as a shape plugin's behaviour: layouts, indices and numbers of any kind. If build_mesh()
// accepts the result, it must be a valid mesh, and render, without shadows and with those that it casts.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "robustness/fuzz/fuzz.h"
#include "support/plugins.h"

using candela::Vec3;
using fuzz::Bytes;

namespace {

/// A shape that behaves as the bytes say.
class WildShape final : public candela::Shape {
  public:
    explicit WildShape(Bytes& bytes) : bytes_(bytes) {}

    void tessellate(const candela::MeshRequest&, candela::MeshSink& sink) const override {
        if (bytes_.at_most(31) == 0) misbehave();
        const candela::MeshLayout layout = any_layout();
        const candela::MeshSpans mesh = sink.allocate(layout);
        if (bytes_.at_most(31) == 0) static_cast<void>(sink.allocate(any_layout()));
        for (std::size_t i = 0; i < layout.vertices && !bytes_.empty(); ++i) {
            mesh.position.set(i, vector());
            if (layout.has_normals) mesh.normal.set(i, vector());
            if (layout.has_derivatives) {
                mesh.dpdu.set(i, vector());
                mesh.dpdv.set(i, vector());
            }
            if (layout.has_uv) {
                mesh.uv.x[i] = bytes_.number();
                mesh.uv.y[i] = bytes_.number();
            }
            if (layout.has_smooth_groups) mesh.smooth_group[i] = index(layout.vertices);
        }
        for (std::uint32_t& corner : mesh.indices) corner = index(layout.vertices);
        if (bytes_.at_most(31) == 0) misbehave();
    }

  private:
    [[noreturn]] void misbehave() const {
        if (bytes_.flag()) throw std::runtime_error("the shape refuses");
        throw 7;  // not a std::exception, as a plugin must throw
    }

    candela::MeshLayout any_layout() const {
        candela::MeshLayout layout{.vertices = size(), .triangles = size()};
        const std::uint32_t has = bytes_.at_most(15);
        layout.has_normals = (has & 1) != 0;
        layout.has_uv = (has & 2) != 0;
        layout.has_derivatives = (has & 4) != 0;
        layout.has_smooth_groups = (has & 8) != 0;
        layout.closedness = static_cast<candela::Closedness>(bytes_.at_most(3));
        return layout;
    }

    /// Mostly small; otherwise more than possible.
    std::size_t size() const {
        const std::uint32_t count = bytes_.at_most(255);
        constexpr std::array<std::size_t, 4> k_too_many = {0xffff'ffffu, std::size_t{1} << 63,
                                                           ~std::size_t{0}, ~std::size_t{0} / 3 + 1};
        return count < 252 ? count % 40 : k_too_many[count - 252];
    }

    /// Mostly an existing one.
    std::uint32_t index(std::size_t count) const {
        const std::uint32_t i = bytes_.at_most(255);
        if (i == 255) return bytes_.take<std::uint32_t>();
        return count > 0 ? i % static_cast<std::uint32_t>(count) : i;
    }

    Vec3 vector() const { return {bytes_.number(), bytes_.number(), bytes_.number()}; }

    Bytes& bytes_;
};

bool is_finite(Vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

bool is_unit_or_zero(Vec3 v) { return v == Vec3{} || std::abs(length(v) - 1) < 1e-3f; }

void check(const candela::Mesh& mesh) {
    using fuzz::require;
    require(mesh.triangle_count() > 0, "a mesh without triangles");
    for (const std::uint32_t corner : mesh.indices)
        require(corner < mesh.vertex_count(), "a corner is not a vertex");
    require(mesh.vertices.size() == mesh.vertex_count(), "vertices without normals");
    require(mesh.face_normal.size() == mesh.triangle_count(), "triangles without normals");
    for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
        require(is_finite(mesh.position.span()[i]), "a position is not finite");
        const Vec3 n = mesh.vertices[i].normal;
        require(is_unit_or_zero(n),
                fmt::format("vertex normal ({}, {}, {}) is neither unit nor zero", n.x, n.y, n.z));
    }
    for (std::size_t i = 0; i < mesh.triangle_count(); ++i) {
        const Vec3 n = mesh.face_normal.span()[i];
        require(is_unit_or_zero(n),
                fmt::format("face normal ({}, {}, {}) is neither unit nor zero", n.x, n.y, n.z));
    }
}

/// A finite vector; `otherwise` if the bytes do not contain one.
Vec3 finite(Bytes& bytes, Vec3 otherwise) {
    const Vec3 v{bytes.number(), bytes.number(), bytes.number()};
    return is_finite(v) ? v : otherwise;
}

/// An observer that a scene may have: see the constraints of [observer].
candela::Observer observer_from(Bytes& bytes) {
    candela::Observer observer{.position = {0, 0, 8}, .look_at = {}};
    observer.projection = static_cast<candela::Projection>(bytes.at_most(1));
    const float fov = bytes.number();
    if (fov > 0 && fov < 180) observer.fov = fov;
    const float height = bytes.number();
    observer.height = height > 0 && std::isfinite(height) ? height : 4;
    const Vec3 position = finite(bytes, observer.position);
    const Vec3 view = normalized(observer.look_at - position);
    if (view != Vec3{} && length(cross(view, observer.up)) >= 1e-6f) observer.position = position;
    return observer;
}

candela::Transform placement_from(Bytes& bytes) {
    candela::Transform transform{.position = finite(bytes, {}), .rotation = finite(bytes, {})};
    const Vec3 scale = finite(bytes, {1, 1, 1});
    if (scale.x > 0 && scale.y > 0 && scale.z > 0) transform.scale = scale;
    return transform;
}

/// Every mesh is tested for overlap with others.
void ask_geometry(const candela::Mesh& mesh) {
    const auto body_of = [](const candela::Mesh& m) {
        return candela::Body(m.position.span(), m.vertex_count(), m.indices, m.closed);
    };
    static const candela::Mesh k_cube = candela::build_mesh(*instance<candela::Shape>("cube"), {}, {},
                                                            *instance<candela::ShadingModel>("flat"));
    static const candela::Body k_block = body_of(k_cube);
    const candela::Body body = body_of(mesh);
    static_cast<void>(body.contains({0.25f, 0.125f, 0}));
    static_cast<void>(overlap(body, k_block));
    static_cast<void>(overlap(body, body));
}

void add_lights(candela::RenderScene& scene) {
    using candela::Light;
    const auto add = [&](const char* name, Given given) {
        scene.lights.push_back({name, instance<Light>(name, given)});
    };
    add("ambient", {});
    add("point", {{"position", Vec3{1, 2, 3}}, {"intensity", 20.0}});
    add("directional", {{"direction", Vec3{-1, -1, -1}}});
    add("spot", {{"position", Vec3{0, 4, 0}}, {"direction", Vec3{0, -1, 0}}});
}

void render_small(candela::RenderScene& scene, Bytes& bytes) {
    constexpr std::array k_samples = {1, 4, 8, 16};
    scene.image = {.width = 40, .height = 24, .samples = k_samples[bytes.at_most(3)], .background = {}};
    const auto pixels = static_cast<candela::PixelType>(bytes.at_most(1));
    const int tile_size = 16 * static_cast<int>(1 + bytes.at_most(1));
    const auto render = [&] {
        candela::Film film(scene.image.width, scene.image.height, pixels, candela::ColorEncoding::srgb);
        candela::render(scene, film, {.threads = 1, .tile_size = tile_size});
        for (const float channel : film.view().reals) {
            fuzz::require(std::isfinite(channel), "a pixel is not finite");
        }
    };
    render();
    const candela::Mesh& mesh = scene.objects[0].mesh;
    const std::array occluders = {
        candela::Occluder{.mesh = &mesh, .is_solid = mesh.closed && !mesh.one_sided}};
    scene.occlusion.emplace(occluders);
    scene.lights[0].ambient_occlusion = {.rays = 4, .distance = 1};
    render();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    constexpr std::array k_shadings = {"flat", "gouraud", "phong"};
    constexpr std::array k_reflections = {"lambert", "half-lambert", "phong", "blinn-phong"};
    Bytes bytes(data, size);
    const char* const shading = k_shadings[bytes.at_most(2)];
    const char* const reflection = k_reflections[bytes.at_most(3)];
    candela::RenderScene scene;
    scene.observer = observer_from(bytes);
    candela::RenderObject object{.label = "1", .mesh = {}, .surface = {}};
    object.surface = {.color = {0.5f, 0.5f, 0.5f},
                      .shading_plugin = shading,
                      .shading = instance<candela::ShadingModel>(shading),
                      .reflection_plugin = reflection,
                      .reflection = instance<candela::ReflectionModel>(reflection)};
    const candela::Transform transform = placement_from(bytes);
    const candela::MeshRequest request{.uv = bytes.flag(), .derivatives = bytes.flag()};
    const bool asks_well = bytes.flag();
    try {
        object.mesh = candela::build_mesh(
            WildShape(bytes), request, asks_well ? candela::Transform{} : transform, *object.surface.shading);
    } catch (const std::exception& problem) {
        fuzz::require(*problem.what() != '\0', "a refusal is empty");
        return 0;
    } catch (int) {
        return 0;
    }
    check(object.mesh);
    ask_geometry(object.mesh);
    scene.objects.push_back(std::move(object));
    add_lights(scene);
    render_small(scene, bytes);
    return 0;
}
