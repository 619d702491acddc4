// One tile, from fragments to pixels.
module;

#include "candela/kernel/simd_dispatch.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

module candela.render;

import :tile;
import candela.api;
import candela.geometry;
import candela.raster;
import candela.scene;
import candela.shading;

namespace candela {

namespace {

/// Adds the intensities of consecutive runs of fragments to their pixels.
struct AddLoop {
    CANDELA_BATCH_LOOP static void run(const FragmentRun* runs, std::size_t count, ConstVec3Span intensity,
                                       Vec3Span pixels) {
        for (const FragmentRun *run = runs, *const end = runs + count; run != end;) {
            const std::uint32_t first = run->pixel;
            const Vec3Span to{pixels.x + first, pixels.y + first, pixels.z + first};
            if (run->weight != 1) {
                to.x[0] += run->weight * intensity.x[0];
                to.y[0] += run->weight * intensity.y[0];
                to.z[0] += run->weight * intensity.z[0];
                intensity = intensity.from(1);
                ++run;
                continue;
            }
            // Nothing else is visible there, and nothing has been written yet.
            const std::uint32_t length = run->count;
            CANDELA_VECTORIZE
            for (std::uint32_t i = 0; i < length; ++i) {
                to.x[i] = intensity.x[i];
                to.y[i] = intensity.y[i];
                to.z[i] = intensity.z[i];
            }
            intensity = intensity.from(length);
            ++run;
        }
    }
};

constexpr float k_infinitely_far = std::numeric_limits<float>::infinity();

/// A vertex side as an index.
std::uint32_t index_of(const ProjectedMesh& mesh, std::uint32_t triangle, std::size_t k, bool is_back) {
    return 2 * mesh.mesh.indices[3 * std::size_t{triangle} + k] + (is_back ? 1 : 0);
}

/// The value of an object's term at a pixel without an object.
Rgb value_of_nothing(Term term) {
    switch (term) {
        case Term::depth:
            return {k_infinitely_far, k_infinitely_far, k_infinitely_far};
        case Term::object:
        case Term::triangle:
            return {-1, -1, -1};
        default:
            return {};
    }
}

}  // namespace

TileShader::TileShader() { batch_.resize(k_batch_size); }

void TileShader::begin(const RenderScene& scene, const ProjectedScene& projected, Term term,
                       std::optional<std::size_t> light, std::span<const ShownParameter> parameter) {
    scene_ = &scene;
    projected_ = &projected;
    term_ = term;
    parameter_ = parameter;
    has_background_ = shows_background(term, light);
    LightingContext context = lighting_context(scene, projected.camera, transmitters_);
    if (light) {
        context.lights = context.lights.subspan(*light, 1);
        context.environment = nullptr;
    }
    surface_shader_.begin(context);
    points_lit_ = 0;
    brightest_ = 0;
}

LightingContext lighting_context(const RenderScene& scene, const Camera& camera,
                                 std::vector<Transmitter>& transmitters) {
    transmitters.clear();
    if (scene.occlusion && (scene.occlusion->has_transparent() || scene.occlusion->has_see_through())) {
        for (const RenderObject& object : scene.objects)
            transmitters.push_back(
                {object.surface.environment_reflection, object.surface.color, &object.surface, &object.mesh});
    }
    return {.lights = scene.lights,
            .environment = &scene.environment,
            .camera = camera,
            .occlusion = scene.occlusion ? &*scene.occlusion : nullptr,
            .pattern = scene.shadow_pattern,
            .samples = scene.image.samples,
            .transmitters = transmitters};
}

ShadedObject shaded_object(const RenderScene& scene, std::uint32_t index) {
    const RenderObject& object = scene.objects[index];
    return {.mesh = &object.mesh,
            .tree = object.tree ? &*object.tree : nullptr,
            .index = index,
            .receives_shadows = object.receives_shadows};
}

PointNeeds needs_of(const RenderScene& scene, const SurfaceModels& surface) {
    PointNeeds needs = surface.needs();
    const bool has_shadows = scene.occlusion.has_value();
    needs.pixel = needs.triangle_index = has_shadows;
    needs.face_normal |= has_shadows;
    return needs;
}

bool shows_background(Term term, std::optional<std::size_t> light) {
    return term == Term::background || (term == Term::intensity && !light);
}

std::optional<Rgb> uniform_background(const RenderScene& scene, Term term, std::optional<std::size_t> light) {
    if (shows_background(term, light))
        return scene.environment.is_uniform() ? std::optional(scene.environment.seen({})) : std::nullopt;
    return value_of_nothing(term);
}
// Skips the pixels that belong to a single fragment, unless they are shown without it.
void TileShader::fill_background(const VisibleTile& visible) {
    pixels_.resize(visible.plane());
    const Vec3Span pixels = pixels_.span();
    if (!has_background_ || term_ == Term::background) {
        const Rgb everywhere = has_background_ ? Rgb{} : value_of_nothing(term_);
        std::ranges::fill(pixels_.x, everywhere.r);
        std::ranges::fill(pixels_.y, everywhere.g);
        std::ranges::fill(pixels_.z, everywhere.b);
    }
    if (!has_background_) return;
    const bool is_uniform = scene_->environment.is_uniform();
    const Rgb everywhere = is_uniform ? scene_->environment.seen({}) : Rgb{};
    const auto fill = [&](const BackgroundRun& run) {
        if (is_uniform) {
            const Rgb background = run.weight * everywhere;
            std::fill_n(pixels.x + run.pixel, run.count, background.r);
            std::fill_n(pixels.y + run.pixel, run.count, background.g);
            std::fill_n(pixels.z + run.pixel, run.count, background.b);
            return;
        }
        const auto stride = static_cast<std::uint32_t>(visible.stride);
        const std::uint32_t row = run.pixel / stride, column = run.pixel % stride;
        if (run.weight <= 0) {
            for (float* const channel : {pixels.x, pixels.y, pixels.z})
                std::fill_n(channel + run.pixel, run.count, 0.0f);
            return;
        }
        towards_.resize(run.count);
        for (std::uint32_t i = 0; i < run.count; ++i) {
            towards_.span().set(i, projected_->camera.view_through(
                                       static_cast<float>(visible.x0) + static_cast<float>(column + i) + 0.5f,
                                       static_cast<float>(visible.y0) + static_cast<float>(row) + 0.5f));
        }
        const Vec3Span to = pixels.from(run.pixel);
        scene_->environment.look(run.count, std::as_const(towards_).span(), to);
        for (std::uint32_t i = 0; run.weight != 1 && i < run.count; ++i) to.set(i, run.weight * to[i]);
    };
    if (!visible.is_empty) {
        for (const BackgroundRun& run : visible.fragments.background()) fill(run);
        return;
    }
    for (int row = 0; row < visible.height; ++row)
        fill(
            {static_cast<std::uint32_t>(row * visible.stride), static_cast<std::uint32_t>(visible.width), 1});
}

void TileShader::add_background(const VisibleTile& layer) {
    if (!has_background_) return;
    const Vec3Span pixels = pixels_.span();
    const bool is_uniform = scene_->environment.is_uniform();
    const auto stride = static_cast<std::uint32_t>(layer.stride);
    for (const BackgroundRun& run : layer.fragments.background()) {
        seen_.resize(run.count);
        towards_.resize(run.count);
        for (std::uint32_t i = 0; i < run.count; ++i) {
            if (is_uniform) {
                const Rgb everywhere = scene_->environment.seen({});
                seen_.span().set(i, {everywhere.r, everywhere.g, everywhere.b});
                continue;
            }
            const std::uint32_t pixel = run.pixel + i, column = pixel % stride, row = pixel / stride;
            towards_.span().set(i, projected_->camera.view_through(
                                       static_cast<float>(layer.x0) + static_cast<float>(column) + 0.5f,
                                       static_cast<float>(layer.y0) + static_cast<float>(row) + 0.5f));
        }
        if (!is_uniform) scene_->environment.look(run.count, std::as_const(towards_).span(), seen_.span());
        for (std::uint32_t i = 0; i < run.count; ++i)
            pixels.set(run.pixel + i, std::as_const(pixels_).span()[run.pixel + i] +
                                          run.weight * std::as_const(seen_).span()[i]);
    }
}

ProjectedMesh TileShader::mesh_of(const FragmentList& fragments) const {
    return {*projected_, scene_->objects[fragments.object].mesh, projected_->first_vertex[fragments.object]};
}

void TileShader::shade_points(std::uint32_t object, const Vec3Span& intensity) {
    const RenderObject& solid = scene_->objects[object];
    const ShadedObject shaded = shaded_object(*scene_, object);
    apply_textures(solid.surface, points_);
    if (term_ == Term::intensity) {
        brightest_ = std::max(brightest_, surface_shader_.shade(solid.surface, shaded, points_, intensity));
    } else {
        const ShownParameter parameter = object < parameter_.size() ? parameter_[object] : ShownParameter{};
        surface_shader_.find_term(term_, parameter, solid.surface, shaded, points_, intensity);
    }
    points_lit_ += points_.count;
}

void TileShader::accumulate(std::span<const FragmentRun> runs, const ConstVec3Span& intensity) {
    multiversion<AddLoop>(runs.data(), runs.size(), intensity, pixels_.span());
}

void TileShader::shade_fragments(const FragmentList& fragments) {
    const ProjectedMesh mesh = mesh_of(fragments);
    const PointNeeds needs = needs_of(*scene_, scene_->objects[fragments.object].surface);
    FragmentBatches batches(fragments);
    for (FragmentBatch batch = batches.next(); !batch.runs.empty(); batch = batches.next()) {
        gather_fragments(mesh, batch, needs, points_);
        shade_points(fragments.object, batch_.span());
        accumulate(batch.runs, std::as_const(batch_).span());
    }
}

void TileShader::show_geometry(const FragmentList& fragments) {
    const ProjectedMesh mesh = mesh_of(fragments);
    const bool is_opacity = term_ == Term::opacity;
    const PointNeeds needs =
        is_opacity ? k_opacity_needs
                   : PointNeeds{.vertex_normal = false, .color = false, .uv = term_ == Term::uv};
    const Vec3Span values = batch_.span();
    FragmentBatches batches(fragments);
    for (FragmentBatch batch = batches.next(); !batch.runs.empty(); batch = batches.next()) {
        gather_fragments(mesh, batch, needs, points_);
        if (is_opacity) find_opacity(scene_->objects[fragments.object].surface, points_, values.x);
        for (std::size_t i = 0; i < batch.triangles.size(); ++i)
            values.set(i, is_opacity ? Vec3{values.x[i], values.x[i], values.x[i]}
                                     : geometry_at(i, fragments.object, batch.triangles[i]));
        accumulate(batch.runs, std::as_const(batch_).span());
    }
}

Vec3 TileShader::geometry_at(std::size_t point, std::uint32_t object, std::uint32_t triangle) const {
    const auto everywhere = [](float value) { return Vec3{value, value, value}; };
    const Camera& camera = projected_->camera;
    switch (term_) {
        case Term::depth:
            return everywhere(dot(points_.position.span()[point] - camera.eye, camera.forward));
        case Term::position:
            return points_.position.span()[point];
        case Term::face_normal:
            return points_.facing[point] * points_.face_normal.span()[point];
        case Term::barycentric:
            return points_.barycentric.span()[point];
        case Term::uv:
            return {points_.u[point], points_.v[point], 0};
        case Term::facing:
            return everywhere(points_.facing[point]);
        case Term::object:
            return everywhere(static_cast<float>(object));
        case Term::triangle:
            return everywhere(static_cast<float>(triangle));
        default:
            throw std::invalid_argument("TileShader::show_geometry(): not geometry");
    }
}

void TileShader::shade_faces(const FragmentList& fragments) {
    const ProjectedMesh mesh = mesh_of(fragments);
    const SurfaceModels& surface = scene_->objects[fragments.object].surface;
    sparse_set_.begin(mesh.mesh.triangle_count());
    for (const std::uint32_t triangle : fragments.triangles) sparse_set_.add(triangle);
    const std::span<const std::uint32_t> triangles = sparse_set_.indices();
    places_.resize(whole_vectors(triangles.size()));
    for (std::size_t first = 0; first < triangles.size(); first += k_batch_size) {
        const std::size_t count = std::min(k_batch_size, triangles.size() - first);
        gather_faces(mesh, triangles.subspan(first, count), needs_of(*scene_, surface), points_);
        shade_points(fragments.object, places_.span().from(first));
    }
    FragmentBatches batches(fragments);
    for (FragmentBatch batch = batches.next(); !batch.runs.empty(); batch = batches.next()) {
        for (std::size_t i = 0; i < batch.triangles.size(); ++i)
            batch_.span().set(i, places_.span()[sparse_set_.number_of(batch.triangles[i])]);
        accumulate(batch.runs, std::as_const(batch_).span());
    }
}

void TileShader::shade_vertices(const FragmentList& fragments) {
    const ProjectedMesh mesh = mesh_of(fragments);
    const SurfaceModels& surface = scene_->objects[fragments.object].surface;
    sparse_set_.begin(2 * mesh.mesh.vertex_count());
    std::uint32_t last = k_no_triangle;
    for (const std::uint32_t triangle : fragments.triangles) {
        if (triangle == last) continue;
        last = triangle;
        const bool is_back = mesh.is_back(triangle);
        for (std::size_t k = 0; k < 3; ++k) sparse_set_.add(index_of(mesh, triangle, k, is_back));
    }
    vertices_.clear();
    for (const std::uint32_t index : sparse_set_.indices()) vertices_.push_back({index / 2, index % 2 == 1});
    places_.resize(whole_vectors(vertices_.size()));
    for (std::size_t first = 0; first < vertices_.size(); first += k_batch_size) {
        const std::size_t count = std::min(k_batch_size, vertices_.size() - first);
        gather_vertices(mesh, std::span(vertices_).subspan(first, count), needs_of(*scene_, surface),
                        points_);
        shade_points(fragments.object, places_.span().from(first));
    }
    const ConstVec3Span intensity = std::as_const(places_).span();
    FragmentBatches batches(fragments);
    for (FragmentBatch batch = batches.next(); !batch.runs.empty(); batch = batches.next()) {
        gather_fragments(mesh, batch,
                         {.position = false, .face_normal = false, .vertex_normal = false, .color = false},
                         points_);
        std::uint32_t triangle = k_no_triangle;
        std::array<Vec3, 3> at_corner;
        for (std::size_t i = 0; i < batch.triangles.size(); ++i) {
            if (batch.triangles[i] != triangle) {
                triangle = batch.triangles[i];
                for (std::size_t k = 0; k < 3; ++k) {
                    at_corner[k] =
                        intensity[sparse_set_.number_of(index_of(mesh, triangle, k, points_.facing[i] < 0))];
                }
            }
            const Vec3 b = points_.barycentric.span()[i];
            batch_.span().set(i, b.x * at_corner[0] + b.y * at_corner[1] + b.z * at_corner[2]);
        }
        accumulate(batch.runs, std::as_const(batch_).span());
    }
}

}  // namespace candela
