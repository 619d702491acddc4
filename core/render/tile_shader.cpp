// One tile, from visibility to pixels.
module;

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

module candela.render;

import candela.film;
import candela.fragments;
import candela.lighting;
import candela.math;
import candela.mesh;
import candela.params;
import candela.raster;
import candela.scene;
import candela.shading;

namespace candela {

namespace {

template <class T>
void sort_unique(std::vector<T>& values) {
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
}

template <class T>
std::size_t position_of(const std::vector<T>& sorted, const T& value) {
    return static_cast<std::size_t>(std::lower_bound(sorted.begin(), sorted.end(), value) - sorted.begin());
}

VertexSide corner(const ProjectedMesh& mesh, std::uint32_t triangle, std::size_t k, bool is_back) {
    return {mesh.mesh.corners[3 * std::size_t{triangle} + k], is_back};
}

}  // namespace

void TileViewer::look(int tile, SeenTile& seen) {
    seen.is_empty = !rasterize(projected_, tile, samples_, visibility_);
    seen.x0 = visibility_.x0;
    seen.y0 = visibility_.y0;
    seen.width = visibility_.width;
    seen.height = visibility_.height;
    seen.stride = visibility_.stride;
    if (!seen.is_empty) seen.fragments.collect(projected_, visibility_, seen.background_weight);
}

TileShader::TileShader(const CompiledScene& scene, const ProjectedScene& projected)
    : scene_(scene), projected_(projected), lighting_(scene.lights, scene.environment, projected.camera) {
    batch_.resize(k_batch_size);
}

void TileShader::run(const SeenTile& seen, Film& film) {
    if (seen.is_empty && scene_.environment.is_uniform())
        return film.fill(seen.x0, seen.y0, seen.width, seen.height, scene_.environment.seen({}));
    fill_background(seen);
    if (!seen.is_empty) {
        for (const FragmentList& list : seen.fragments.lists()) shade(list);
        for (int row = 0; row < seen.height; ++row) {
            const auto first = seen.background_weight.begin() + std::ptrdiff_t{row} * seen.stride;
            pixels_shaded_ += static_cast<std::size_t>(
                std::count_if(first, first + seen.width, [](float weight) { return weight < 1; }));
        }
    }
    film.store(seen.x0, seen.y0, seen.width, seen.height, std::as_const(pixels_).span(), seen.stride);
}

/// What is seen beside the objects, as much of each pixel as shows it.
void TileShader::fill_background(const SeenTile& seen) {
    const std::size_t plane = seen.plane();
    pixels_.resize(plane);
    const Vec3Span pixels = pixels_.span();
    if (scene_.environment.is_uniform()) {
        const Rgb background = scene_.environment.seen({});
        const float* const weight = seen.background_weight.data();
        const auto fill = [&](float* to, float channel) {
            for (std::size_t i = 0; i < plane; ++i) to[i] = weight[i] * channel;
        };
        fill(pixels.x, background.r);
        fill(pixels.y, background.g);
        fill(pixels.z, background.b);
        return;
    }
    for (int row = 0; row < seen.height; ++row) {
        for (int column = 0; column < seen.width; ++column) {
            const std::size_t i = static_cast<std::size_t>(row) * static_cast<std::size_t>(seen.stride) +
                                  static_cast<std::size_t>(column);
            const Vec3 towards = projected_.camera.view_through(static_cast<float>(seen.x0 + column) + 0.5f,
                                                                static_cast<float>(seen.y0 + row) + 0.5f);
            const float weight = seen.is_empty ? 1.0f : seen.background_weight[i];
            const Rgb rgb = weight > 0 ? weight * scene_.environment.seen(towards) : Rgb{};
            pixels.set(i, {rgb.r, rgb.g, rgb.b});
        }
    }
}

void TileShader::shade(const FragmentList& fragments) {
    const SolidObject& object = scene_.objects[fragments.object];
    const ProjectedMesh mesh{projected_, object.mesh, projected_.first_vertex[fragments.object]};
    switch (object.surface.shading->lighting_rate()) {
        case LightingRate::face:
            return shade_faces(mesh, fragments);
        case LightingRate::vertex:
            return shade_vertices(mesh, fragments);
        case LightingRate::fragment:
            return shade_fragments(mesh, fragments);
    }
}

void TileShader::light(std::uint32_t object, const Vec3Span& intensity) {
    const SolidObject& solid = scene_.objects[object];
    const Interior interior{&solid.mesh, solid.tree ? &*solid.tree : nullptr};
    brightest_ = std::max(brightest_, lighting_.light(solid.surface, interior, points_, intensity));
    points_lit_ += points_.count;
}

void TileShader::add(const FragmentList& fragments, std::size_t first, std::size_t count,
                     ConstVec3Span intensity) {
    const Vec3Span pixels = pixels_.span();
    const std::uint32_t* const pixel = &fragments.pixel[first];
    const float* const weight = &fragments.weight[first];
    // With one sample a pixel each pixel is there once, so that these are pixels side by side.
    const bool is_stretch = scene_.image.samples == 1 && pixel[count - 1] - pixel[0] == count - 1;
    if (is_stretch) {
        const auto add_stretch = [&](float* to, const float* from) {
            for (std::size_t i = 0; i < count; ++i) to[i] += weight[i] * from[i];
        };
        add_stretch(pixels.x + pixel[0], intensity.x);
        add_stretch(pixels.y + pixel[0], intensity.y);
        add_stretch(pixels.z + pixel[0], intensity.z);
        return;
    }
    for (std::size_t i = 0; i < count; ++i) pixels.set(pixel[i], pixels[pixel[i]] + weight[i] * intensity[i]);
}

/// Light at every fragment.
void TileShader::shade_fragments(const ProjectedMesh& mesh, const FragmentList& fragments) {
    const SurfaceModels& surface = scene_.objects[fragments.object].surface;
    for (std::size_t first = 0; first < fragments.size(); first += k_batch_size) {
        const std::size_t count = std::min(k_batch_size, fragments.size() - first);
        gather_fragments(mesh, fragments, first, count, surface.needs(), points_);
        light(fragments.object, batch_.span());
        add(fragments, first, count, std::as_const(batch_).span());
    }
}

/// Light once a face that the tile sees.
void TileShader::shade_faces(const ProjectedMesh& mesh, const FragmentList& fragments) {
    const SurfaceModels& surface = scene_.objects[fragments.object].surface;
    triangles_ = fragments.triangle;
    sort_unique(triangles_);
    places_.resize(triangles_.size());
    for (std::size_t first = 0; first < triangles_.size(); first += k_batch_size) {
        const std::size_t count = std::min(k_batch_size, triangles_.size() - first);
        gather_faces(mesh, std::span(triangles_).subspan(first, count), surface.needs(), points_);
        light(fragments.object, places_.span().from(first));
    }
    for (std::size_t first = 0; first < fragments.size(); first += k_batch_size) {
        const std::size_t count = std::min(k_batch_size, fragments.size() - first);
        for (std::size_t i = 0; i < count; ++i) {
            batch_.span().set(i, places_.span()[position_of(triangles_, fragments.triangle[first + i])]);
        }
        add(fragments, first, count, std::as_const(batch_).span());
    }
}

/// Light once a vertex of a face that the tile sees, and once a side of it; interpolated in between.
void TileShader::shade_vertices(const ProjectedMesh& mesh, const FragmentList& fragments) {
    const SurfaceModels& surface = scene_.objects[fragments.object].surface;
    triangles_ = fragments.triangle;
    sort_unique(triangles_);
    vertices_.clear();
    for (const std::uint32_t triangle : triangles_) {
        const bool is_back = mesh.is_back(triangle);
        for (std::size_t k = 0; k < 3; ++k) vertices_.push_back(corner(mesh, triangle, k, is_back));
    }
    sort_unique(vertices_);
    places_.resize(vertices_.size());
    for (std::size_t first = 0; first < vertices_.size(); first += k_batch_size) {
        const std::size_t count = std::min(k_batch_size, vertices_.size() - first);
        gather_vertices(mesh, std::span(vertices_).subspan(first, count), surface.needs(), points_);
        light(fragments.object, places_.span().from(first));
    }
    const ConstVec3Span intensity = std::as_const(places_).span();
    for (std::size_t first = 0; first < fragments.size(); first += k_batch_size) {
        const std::size_t count = std::min(k_batch_size, fragments.size() - first);
        gather_fragments(mesh, fragments, first, count, {}, points_);
        std::array<Vec3, 3> at_corner;
        for (std::size_t i = 0; i < count; ++i) {
            const std::uint32_t triangle = fragments.triangle[first + i];
            if (i == 0 || triangle != fragments.triangle[first + i - 1]) {
                for (std::size_t k = 0; k < 3; ++k) {
                    at_corner[k] =
                        intensity[position_of(vertices_, corner(mesh, triangle, k, points_.facing[i] < 0))];
                }
            }
            const Vec3 b = points_.barycentric.span()[i];
            batch_.span().set(i, b.x * at_corner[0] + b.y * at_corner[1] + b.z * at_corner[2]);
        }
        add(fragments, first, count, std::as_const(batch_).span());
    }
}

}  // namespace candela
