module;

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

module candela.render;

import :pixel_inspector;
import :tile;
import :tile_layers;
import candela.api;
import candela.geometry;
import candela.raster;
import candela.scene;
import candela.shading;

namespace candela {

namespace {

constexpr int k_tile_size = 32;

/// The fragments of one pixel, traced.
class FragmentTracer {
  public:
    FragmentTracer(const RenderScene& scene, const ProjectedScene& projected)
        : scene_(scene), projected_(projected) {
        shader_.begin(lighting_context(scene, projected.camera, transmitters_));
    }

    InspectedFragment trace(std::uint32_t object, const FragmentRun& run, std::uint32_t triangle) {
        const RenderObject& solid = scene_.objects[object];
        const ProjectedMesh mesh{projected_, solid.mesh, projected_.first_vertex[object]};
        PointNeeds needs = needs_of(scene_, solid.surface);
        needs.face_normal = needs.vertex_normal = needs.barycentric = true;
        gather_fragments(mesh, {std::span(&run, 1), std::span(&triangle, 1)}, needs, points_);
        InspectedFragment fragment{.object = object,
                                   .triangle = triangle,
                                   .weight = run.weight,
                                   .position = points_.position.span()[0],
                                   .barycentric = points_.barycentric.span()[0],
                                   .rate = solid.surface.shading->shading_rate()};
        switch (fragment.rate) {
            case ShadingRate::fragment:
                fragment.points.push_back(trace_point(object));
                break;
            case ShadingRate::face:
                gather_faces(mesh, std::span(&triangle, 1), needs, points_);
                fragment.points.push_back(trace_point(object));
                break;
            case ShadingRate::vertex:
                trace_vertices(mesh, object, triangle, fragment);
                return fragment;
        }
        fragment.intensity = fragment.points[0].intensity;
        return fragment;
    }

  private:
    PointTrace trace_point(std::uint32_t object) {
        const RenderObject& solid = scene_.objects[object];
        apply_textures(solid.surface, points_);
        return shader_.trace(solid.surface, shaded_object(scene_, object), points_);
    }

    void trace_vertices(const ProjectedMesh& mesh, std::uint32_t object, std::uint32_t triangle,
                        InspectedFragment& fragment) {
        const RenderObject& solid = scene_.objects[object];
        const bool is_back = points_.facing[0] < 0;
        std::array<Vec3, 3> at_corner;
        for (std::size_t k = 0; k < 3; ++k) {
            const VertexSide side{solid.mesh.indices[3 * std::size_t{triangle} + k], is_back};
            gather_vertices(mesh, std::span(&side, 1), needs_of(scene_, solid.surface), points_);
            fragment.points.push_back(trace_point(object));
            at_corner[k] = fragment.points.back().intensity;
        }
        const Vec3 b = fragment.barycentric;
        fragment.intensity = b.x * at_corner[0] + b.y * at_corner[1] + b.z * at_corner[2];
    }

    const RenderScene& scene_;
    const ProjectedScene& projected_;
    std::vector<Transmitter> transmitters_;
    SurfaceShader shader_;
    SurfacePoints points_;
};

float background_weight(const TileFragments& fragments, std::uint32_t pixel) {
    for (const BackgroundRun& run : fragments.background()) {
        if (pixel >= run.pixel && pixel - run.pixel < run.count) return run.weight;
    }
    return 0;
}

/// Calls `visit(object, run, triangle)` for each fragment of a pixel.
template <class Visit>
void each_fragment(const TileFragments& fragments, std::uint32_t pixel, Visit visit) {
    for (const FragmentList& list : fragments.lists()) {
        std::size_t first = 0;
        for (const FragmentRun& run : list.runs) {
            const std::size_t of_run = first;
            first += run.count;
            if (pixel < run.pixel || pixel - run.pixel >= run.count) continue;
            const std::uint32_t offset = pixel - run.pixel;
            visit(list.object,
                  FragmentRun{.pixel = pixel,
                              .count = 1,
                              .x = run.x + static_cast<float>(offset),
                              .y = run.y,
                              .weight = run.weight},
                  list.triangles[of_run + offset]);
        }
    }
}

}  // namespace

InspectedPixel inspect_pixel(const RenderScene& scene, int x, int y) {
    const int width = scene.image.width, height = scene.image.height;
    if (x < 0 || y < 0 || x >= width || y >= height) throw std::out_of_range("the picture has no such pixel");
    ProjectedScene projected;
    const int tile_row = y / k_tile_size;
    const RowRange rows{tile_row * k_tile_size, std::min((tile_row + 1) * k_tile_size, height)};
    project_scene(scene, width, height, rows, k_tile_size, scene.image.samples, projected);
    TileWorker worker;
    worker.shader.begin(scene, projected);
    VisibleTile& visible = worker.visible;
    find_visible(projected, tile_row * projected.tile_columns + x / k_tile_size, worker.visibility, visible);

    // Renders the whole tile by the pipeline itself, so that the pixel is the picture's by construction.
    InspectedPixel result;
    Film film(width, height, PixelType::byte, display_of(scene), rows);
    shade_tile(scene, visible, worker, film);
    const std::size_t at = 3 * (static_cast<std::size_t>(y - rows.first) * static_cast<std::size_t>(width) +
                                static_cast<std::size_t>(x));
    std::ranges::copy(film.view().bytes.subspan(at, 3), result.bytes.begin());
    const Vec3 towards =
        projected.camera.view_through(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
    const Rgb background =
        scene.environment.is_uniform() ? scene.environment.seen({}) : scene.environment.seen(towards);
    result.background = {background.r, background.g, background.b};
    if (visible.is_empty) {
        result.background_weight = 1;
        result.intensity = result.background;
        return result;
    }
    const auto pixel = static_cast<std::uint32_t>((y - visible.y0) * visible.stride + (x - visible.x0));
    result.intensity = worker.shader.pixels()[pixel];
    FragmentTracer tracer(scene, projected);
    if (!has_layers(scene, visible)) {
        result.background_weight = background_weight(visible.fragments, pixel);
        each_fragment(visible.fragments, pixel,
                      [&](std::uint32_t object, const FragmentRun& run, std::uint32_t triangle) {
                          result.fragments.push_back(tracer.trace(object, run, triangle));
                      });
        return result;
    }
    TileLayers& layers = worker.layers;
    layers.begin(scene, projected, visible, true);
    while (layers.next()) {
        const TileFragments& fragments = layers.layer().fragments;
        result.background_weight += background_weight(fragments, pixel);
        each_fragment(
            fragments, pixel, [&](std::uint32_t object, const FragmentRun& run, std::uint32_t triangle) {
                InspectedFragment& fragment =
                    result.fragments.emplace_back(tracer.trace(object, run, triangle));
                fragment.layer = layers.number();
                fragment.opacity = layers.opacity_of(projected.first_triangle[object] + triangle, pixel);
            });
    }
    return result;
}

}  // namespace candela
