// The pipeline on one page, from a compiled scene to the film. Shapes have been tessellated and vertex
// normals computed before (build.cpp); the image plugin writes the film afterwards (image_file.cpp).
module;

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <vector>

module candela.render;

import :tile;
import :tile_layers;
import candela.api;
import candela.geometry;
import candela.raster;
import candela.scene;
import candela.shading;
import candela.util;

namespace candela {

Camera camera_of(const Observer& unfitted, int width, int height) {
    const Observer observer = fitted(unfitted, width, height);
    const bool is_perspective = observer.projection == Projection::perspective;
    return Camera::looking(observer.position, observer.look_at, observer.up, observer.projection,
                           is_perspective ? observer.fov : observer.height, width, height);
}

// Projection: vertices onto the screen, triangles clipped and sorted into tiles.
void project_scene(const RenderScene& scene, int width, int height, RowRange rows, int tile_size, int samples,
                   ProjectedScene& projected) {
    std::vector<const Mesh*> meshes;
    for (const RenderObject& object : scene.objects) meshes.push_back(&object.mesh);
    try {
        project(meshes, camera_of(scene.observer, width, height), tile_size, samples, projected,
                TileRows{rows.first / tile_size, (rows.end + tile_size - 1) / tile_size});
    } catch (const std::length_error& problem) {
        throw Error(ErrorCategory::failure, problem.what());
    }
}

// Areas with nothing but background: filled in rows across many tiles, in half the time of filling them tile
// by tile.
void fill_empty_tiles(const ProjectedScene& projected, int row, Rgb background, Film& film,
                      std::span<std::uint8_t> is_done) {
    const int size = projected.tile_size, columns = projected.tile_columns;
    int first = 0;
    while (first < columns) {
        int end = first;
        while (end < columns && !projected.is_near(end, row)) is_done[static_cast<std::size_t>(end++)] = 1;
        const int width = std::min(end * size, projected.camera.width) - first * size;
        const int height = std::min((row + 1) * size, projected.camera.height) - row * size;
        if (end > first) film.fill(first * size, row * size, width, height, background);
        first = end + 1;
    }
}

// Visibility: the nearest triangle at each sample, then fragments, sorted by object and cut into batches.
void find_visible(const ProjectedScene& projected, int tile, TileVisibility& visibility,
                  VisibleTile& visible) {
    visible.is_empty = !rasterize(projected, tile, visibility);
    visible.x0 = visibility.x0;
    visible.y0 = visibility.y0;
    visible.width = visibility.width;
    visible.height = visibility.height;
    visible.stride = visibility.stride;
    if (!visible.is_empty) visible.fragments.collect(projected, visibility);
}

namespace {

// Shading: at each point of a batch, the shading plugin's normal; then, light by light, the light plugin's
// intensity and what the reflection plugin reflects of it to the observer (SurfaceShader::shade()).
void shade_object(const RenderScene& scene, const FragmentList& fragments, TileShader& shader) {
    if (shader.term() == Term::background) return;
    if (is_geometric(shader.term())) return shader.show_geometry(fragments);
    switch (scene.objects[fragments.object].surface.shading->shading_rate()) {
        case ShadingRate::face:
            return shader.shade_faces(fragments);
        case ShadingRate::vertex:
            return shader.shade_vertices(fragments);
        case ShadingRate::fragment:
            return shader.shade_fragments(fragments);
    }
}

// Surfaces that show what is behind them: the layers of the tile, one after the other.
void shade_layers(const RenderScene& scene, const VisibleTile& visible, TileWorker& worker) {
    TileLayers& layers = worker.layers;
    layers.begin(scene, worker.shader.projected(), visible, is_additive(worker.shader.term()));
    while (layers.next()) {
        const VisibleTile& layer = layers.layer();
        if (layers.number() == 0) {
            worker.shader.fill_background(layer);
            worker.pixels_shaded += layer.fragments.pixels_seen();
        } else {
            worker.shader.add_background(layer);
        }
        for (const FragmentList& fragments : layer.fragments.lists())
            shade_object(scene, fragments, worker.shader);
    }
}

void store(const VisibleTile& visible, const TileShader& shader, Film& film) {
    film.store(visible.x0, visible.y0, visible.width, visible.height, shader.pixels(), visible.stride);
}

}  // namespace

// From fragments to the film: the background, then object by object.
void shade_tile(const RenderScene& scene, const VisibleTile& visible, TileWorker& worker, Film& film) {
    if (has_layers(scene, visible)) {
        shade_layers(scene, visible, worker);
        return store(visible, worker.shader, film);
    }
    worker.shader.fill_background(visible);
    if (!visible.is_empty) {
        for (const FragmentList& fragments : visible.fragments.lists())
            shade_object(scene, fragments, worker.shader);
        worker.pixels_shaded += visible.fragments.pixels_seen();
    }
    store(visible, worker.shader, film);
}

}  // namespace candela
