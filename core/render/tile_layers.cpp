module;

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

module candela.render;

import :tile_layers;
import candela.raster;
import candela.shading;

namespace candela {

bool has_layers(const RenderScene& scene, const VisibleTile& visible) {
    return !visible.is_empty &&
           std::ranges::any_of(visible.fragments.lists(), [&](const FragmentList& fragments) {
               return scene.objects[fragments.object].surface.is_see_through();
           });
}

void TileLayers::begin(const RenderScene& scene, const ProjectedScene& projected, const VisibleTile& tile,
                       bool blends) {
    scene_ = &scene;
    projected_ = &projected;
    blends_ = blends;
    is_first_ = true;
    number_ = 0;
    object_ = 0;
    layer_.x0 = tile.x0;
    layer_.y0 = tile.y0;
    layer_.width = tile.width;
    layer_.height = tile.height;
    layer_.stride = tile.stride;
    layer_.is_empty = false;
}

template <class Visit>
void TileLayers::each_sample(Visit visit) const {
    for (int s = 0; s < visibility_.samples; ++s) {
        for (int row = 0; row < visibility_.height; ++row) {
            const std::size_t first =
                static_cast<std::size_t>(s) * visibility_.plane() +
                static_cast<std::size_t>(row) * static_cast<std::size_t>(visibility_.stride);
            for (std::size_t i = first; i < first + static_cast<std::size_t>(visibility_.width); ++i)
                visit(i);
        }
    }
}

bool TileLayers::next() {
    if (is_first_) {
        const int size = projected_->tile_size;
        rasterize(*projected_, layer_.y0 / size * projected_->tile_columns + layer_.x0 / size, visibility_);
        left_.assign(visibility_.triangle.size(), 1.0f);
        opacity_.assign(visibility_.triangle.size(), k_unknown);
        before_ = visibility_;
        is_first_ = false;
    } else {
        bool any_left = false;
        each_sample([&](std::size_t i) {
            left_[i] *= visibility_.triangle[i] == k_no_triangle ? 0.0f : 1 - opacity_[i];
            any_left = any_left || left_[i] > 0;
        });
        if (!any_left) return false;
        go_behind();
        ++number_;
    }
    skip_absent();
    layer_.fragments.collect_layer(*projected_, visibility_, left_, opacity_, number_ == 0);
    return true;
}

/// Samples that are not yet covered look behind their surface.
void TileLayers::go_behind() {
    std::ranges::fill(before_.depth, k_nowhere);
    each_sample([&](std::size_t i) {
        if (left_[i] <= 0) return;
        before_.triangle[i] = visibility_.triangle[i];
        before_.depth[i] = visibility_.depth[i];
    });
    rasterize_behind(*projected_, before_, behind_);
    each_sample([&](std::size_t i) {
        visibility_.triangle[i] = behind_.triangle[i];
        visibility_.depth[i] = behind_.depth[i];
        opacity_[i] = left_[i] > 0 ? k_unknown : 0;
    });
}

/// Samples whose surface is not there see what is behind it.
void TileLayers::skip_absent() {
    for (;;) {
        find_opacities();
        std::ranges::fill(before_.depth, k_nowhere);
        bool any_absent = false;
        each_sample([&](std::size_t i) {
            if (left_[i] <= 0 || visibility_.triangle[i] == k_no_triangle || opacity_[i] > 0) return;
            before_.triangle[i] = visibility_.triangle[i];
            before_.depth[i] = visibility_.depth[i];
            any_absent = true;
        });
        if (!any_absent) break;
        rasterize_behind(*projected_, before_, behind_);
        each_sample([&](std::size_t i) {
            if (before_.depth[i] == k_nowhere) return;
            visibility_.triangle[i] = behind_.triangle[i];
            visibility_.depth[i] = behind_.depth[i];
            opacity_[i] = k_unknown;
        });
    }
    if (blends_) return;
    each_sample([&](std::size_t i) {
        if (opacity_[i] > 0) opacity_[i] = 1;
    });
}

std::uint32_t TileLayers::object_of(std::uint32_t triangle) {
    const auto& first = projected_->first_triangle;
    if (triangle < first[object_] || triangle >= first[object_ + 1])
        object_ = static_cast<std::uint32_t>(std::ranges::upper_bound(first, triangle) - first.begin() - 1);
    return object_;
}

void TileLayers::find_opacities() {
    const std::span<const SamplePosition> pattern = sample_pattern(visibility_.samples);
    each_sample([&](std::size_t i) {
        if (opacity_[i] != k_unknown) return;
        const std::uint32_t triangle = visibility_.triangle[i];
        if (triangle == k_no_triangle) {
            opacity_[i] = 1;
            return;
        }
        const std::uint32_t object = object_of(triangle);
        if (const std::optional<float> uniform = uniform_opacity(scene_->objects[object].surface)) {
            opacity_[i] = *uniform;
            return;
        }
        if (object != batch_object_ || runs_.size() == k_batch_size) flush();
        batch_object_ = object;
        const std::size_t pixel = i % visibility_.plane();
        const auto stride = static_cast<std::size_t>(visibility_.stride);
        const std::size_t column = pixel % stride, row = pixel / stride;
        const auto [x, y] = pattern[i / visibility_.plane()];
        runs_.push_back(
            {.pixel = static_cast<std::uint32_t>(pixel),
             .count = 1,
             .x =
                 static_cast<float>(visibility_.x0) + static_cast<float>(column) + static_cast<float>(x) / 16,
             .y = static_cast<float>(visibility_.y0) + static_cast<float>(row) + static_cast<float>(y) / 16,
             .weight = 1});
        triangles_.push_back(triangle - projected_->first_triangle[object]);
        places_.push_back(i);
    });
    flush();
}

/// Finds the opacities of the batch.
void TileLayers::flush() {
    if (runs_.empty()) return;
    const RenderObject& object = scene_->objects[batch_object_];
    gather_fragments({*projected_, object.mesh, projected_->first_vertex[batch_object_]}, {runs_, triangles_},
                     k_opacity_needs, points_);
    found_.resize(k_batch_size + k_lanes);
    find_opacity(object.surface, points_, found_.data());
    for (std::size_t k = 0; k < places_.size(); ++k) opacity_[places_[k]] = found_[k];
    runs_.clear();
    triangles_.clear();
    places_.clear();
}

float TileLayers::opacity_of(std::uint32_t triangle, std::uint32_t pixel) const {
    float covered = 0, seen = 0;
    for (std::size_t i = pixel; i < visibility_.triangle.size(); i += visibility_.plane()) {
        if (visibility_.triangle[i] != triangle) continue;
        covered += left_[i] * opacity_[i];
        seen += left_[i];
    }
    return seen > 0 ? covered / seen : 0;
}

}  // namespace candela
