// From the samples of a tile to fragments.
module;

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

module candela.fragments;

namespace candela {

void FragmentList::clear() {
    triangle.clear();
    x.clear();
    y.clear();
    pixel.clear();
    weight.clear();
}

void FragmentList::add(std::uint32_t triangle_index, float at_x, float at_y, std::uint32_t at_pixel,
                       float share) {
    triangle.push_back(triangle_index);
    x.push_back(at_x);
    y.push_back(at_y);
    pixel.push_back(at_pixel);
    weight.push_back(share);
}

void FragmentList::add_run(std::uint32_t triangle_index, float at_x, float at_y, std::uint32_t at_pixel,
                           std::size_t count) {
    const std::size_t first = size();
    const std::size_t all = first + count;
    triangle.resize(all, triangle_index);
    y.resize(all, at_y);
    weight.resize(all, 1.0f);
    x.resize(all);
    pixel.resize(all);
    for (std::size_t i = 0; i < count; ++i) {
        x[first + i] = at_x + static_cast<float>(i);
        pixel[first + i] = at_pixel + static_cast<std::uint32_t>(i);
    }
}

FragmentList& TileFragments::list_of(const ProjectedScene& scene, std::uint32_t triangle) {
    const auto& first = scene.first_triangle;
    const auto holds = [&](std::size_t object) {
        return first[object] <= triangle && triangle < first[object + 1];
    };
    if (last_ < used_ && holds(lists_[last_].object)) return lists_[last_];
    for (last_ = 0; last_ < used_; ++last_) {
        if (holds(lists_[last_].object)) return lists_[last_];
    }
    if (used_ == lists_.size()) lists_.emplace_back();
    FragmentList& list = lists_[used_++];
    list.clear();
    list.object = static_cast<std::uint32_t>(std::ranges::upper_bound(first, triangle) - first.begin() - 1);
    return list;
}

void TileFragments::collect(const ProjectedScene& scene, const TileVisibility& visibility,
                            std::vector<float>& background_weight) {
    used_ = 0;
    last_ = 0;
    background_weight.assign(visibility.plane(), 0.0f);
    if (visibility.samples == 1) {
        collect_pixels(scene, visibility, background_weight);
    } else {
        collect_samples(scene, visibility, background_weight);
    }
    std::sort(lists_.begin(), lists_.begin() + static_cast<std::ptrdiff_t>(used_),
              [](const FragmentList& a, const FragmentList& b) { return a.object < b.object; });
}

/// One sample a pixel: runs of pixels that see the same triangle.
void TileFragments::collect_pixels(const ProjectedScene& scene, const TileVisibility& visibility,
                                   std::vector<float>& background_weight) {
    for (int row = 0; row < visibility.height; ++row) {
        const std::size_t row_begin =
            static_cast<std::size_t>(row) * static_cast<std::size_t>(visibility.stride);
        const std::uint32_t* const seen = visibility.triangle.data() + row_begin;
        const float y = static_cast<float>(visibility.y0 + row) + 0.5f;
        for (int begin = 0; begin < visibility.width;) {
            const std::uint32_t triangle = seen[begin];
            int end = begin + 1;
            while (end < visibility.width && seen[end] == triangle) ++end;
            const auto first = static_cast<std::uint32_t>(row_begin) + static_cast<std::uint32_t>(begin);
            const auto count = static_cast<std::size_t>(end - begin);
            if (triangle == k_no_triangle) {
                std::fill_n(background_weight.begin() + first, count, 1.0f);
            } else {
                FragmentList& list = list_of(scene, triangle);
                list.add_run(triangle - scene.first_triangle[list.object],
                             static_cast<float>(visibility.x0 + begin) + 0.5f, y, first, count);
            }
            begin = end;
        }
    }
}

/// Several samples a pixel: what each of the triangles that a pixel's samples see contributes to it.
void TileFragments::collect_samples(const ProjectedScene& scene, const TileVisibility& visibility,
                                    std::vector<float>& background_weight) {
    const int samples = visibility.samples;
    const float share = 1 / static_cast<float>(samples);
    const std::span<const SamplePosition> pattern = sample_pattern(samples);

    for (int row = 0; row < visibility.height; ++row) {
        for (int column = 0; column < visibility.width; ++column) {
            const auto pixel = static_cast<std::uint32_t>(row * visibility.stride + column);
            const auto left = static_cast<float>(visibility.x0 + column);
            const auto top = static_cast<float>(visibility.y0 + row);
            // The triangles that the pixel's samples see, in the order of the samples.
            struct Seen {
                std::uint32_t triangle;
                int count, x, y;  // samples, and the sum of their positions in sixteenths
            };
            std::array<Seen, 16> seen;
            std::size_t kinds = 0;
            for (int s = 0; s < samples; ++s) {
                const std::uint32_t triangle = visibility.at(s, column, row);
                const auto [x, y] = pattern[static_cast<std::size_t>(s)];
                std::size_t k = 0;
                while (k < kinds && seen[k].triangle != triangle) ++k;
                if (k == kinds) seen[kinds++] = {triangle, 0, 0, 0};
                ++seen[k].count;
                seen[k].x += x;
                seen[k].y += y;
            }
            for (std::size_t k = 0; k < kinds; ++k) {
                const Seen& s = seen[k];
                const float weight = static_cast<float>(s.count) * share;
                if (s.triangle == k_no_triangle) {
                    background_weight[pixel] = weight;
                    continue;
                }
                // In the pixel's middle; where the triangle covers only part of the pixel, in the middle of
                // that part.
                const bool is_whole = s.count == samples;
                const float sixteenths = 16 * static_cast<float>(s.count);
                const float x = is_whole ? 0.5f : static_cast<float>(s.x) / sixteenths;
                const float y = is_whole ? 0.5f : static_cast<float>(s.y) / sixteenths;
                FragmentList& list = list_of(scene, s.triangle);
                list.add(s.triangle - scene.first_triangle[list.object], left + x, top + y, pixel, weight);
            }
        }
    }
}

}  // namespace candela
