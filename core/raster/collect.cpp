module;

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

module candela.raster;

namespace candela {

void FragmentList::begin(std::uint32_t of_object) {
    object = of_object;
    room_ = k_batch_size;
    runs.clear();
    triangles.clear();
}

void FragmentList::add(FragmentRun run, const std::uint32_t* seen, std::uint32_t first_triangle) {
    const std::size_t before = triangles.size();
    triangles.resize(before + run.count);
    std::uint32_t* const to = triangles.data() + before;
    for (std::uint32_t i = 0; i < run.count; ++i) to[i] = seen[i] - first_triangle;
    while (run.count > room_) {
        FragmentRun first = run;
        first.count = room_;
        runs.push_back(first);
        run.pixel += room_;
        run.x += static_cast<float>(room_);
        run.count -= room_;
        room_ = k_batch_size;
    }
    room_ -= run.count;
    if (room_ == 0) room_ = k_batch_size;
    runs.push_back(run);
}

void FragmentList::prolong(std::uint32_t seen, std::uint32_t first_triangle) {
    FragmentRun& last = runs.back();
    if (room_ == k_batch_size) {  // the batch is full
        const auto count = static_cast<float>(last.count);
        return add({last.pixel + last.count, 1, last.x + count, last.y, last.weight}, &seen, first_triangle);
    }
    triangles.push_back(seen - first_triangle);
    ++last.count;
    if (--room_ == 0) room_ = k_batch_size;
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
    list.begin(static_cast<std::uint32_t>(std::ranges::upper_bound(first, triangle) - first.begin() - 1));
    return list;
}

void TileFragments::begin() {
    used_ = 0;
    last_ = 0;
    background_.clear();
    pixels_seen_ = 0;
}

void TileFragments::sort() {
    std::sort(lists_.begin(), lists_.begin() + static_cast<std::ptrdiff_t>(used_),
              [](const FragmentList& a, const FragmentList& b) { return a.object < b.object; });
}

void TileFragments::collect(const ProjectedScene& scene, const TileVisibility& visibility) {
    begin();
    if (visibility.samples == 1) {
        collect_pixels(scene, visibility);
    } else {
        collect_samples(scene, visibility);
    }
    sort();
}

namespace {

/// The end of the run, beginning at `begin`, of pixels of a row that see one of `count` triangles from
/// `first` on. The first pixel is known to.
int end_of_run(const std::uint32_t* seen, int begin, int width, std::uint32_t first, std::uint32_t count) {
    constexpr int k_block = 16;
    const auto is_other = [&](std::uint32_t triangle) { return triangle - first >= count; };
    int end = begin + 1;
    for (; end + k_block <= width; end += k_block) {
        std::uint32_t others = 0;
        for (int i = 0; i < k_block; ++i) others |= is_other(seen[end + i]) ? 1u : 0u;
        if (others != 0) break;
    }
    while (end < width && !is_other(seen[end])) ++end;
    return end;
}

}  // namespace

/// One sample per pixel: runs of pixels that see the same object.
void TileFragments::collect_pixels(const ProjectedScene& scene, const TileVisibility& visibility) {
    for (int row = 0; row < visibility.height; ++row) {
        const auto row_begin = static_cast<std::uint32_t>(row * visibility.stride);
        const std::uint32_t* const seen = visibility.triangle.data() + row_begin;
        const float y = static_cast<float>(visibility.y0 + row) + 0.5f;
        for (int begin = 0; begin < visibility.width;) {
            const std::uint32_t first_pixel = row_begin + static_cast<std::uint32_t>(begin);
            if (seen[begin] == k_no_triangle) {
                const int end = end_of_run(seen, begin, visibility.width, k_no_triangle, 1);
                background_.push_back({first_pixel, static_cast<std::uint32_t>(end - begin), 1.0f});
                begin = end;
                continue;
            }
            FragmentList& list = list_of(scene, seen[begin]);
            const std::uint32_t first = scene.first_triangle[list.object];
            const int end = end_of_run(seen, begin, visibility.width, first,
                                       scene.first_triangle[list.object + 1] - first);
            const auto count = static_cast<std::uint32_t>(end - begin);
            pixels_seen_ += count;
            list.add({.pixel = first_pixel,
                      .count = count,
                      .x = static_cast<float>(visibility.x0 + begin) + 0.5f,
                      .y = y,
                      .weight = 1},
                     seen + begin, first);
            begin = end;
        }
    }
}

namespace {

/// A triangle seen by samples of one pixel: how many, and the sum of their positions in sixteenths.
struct SeenTriangle {
    std::uint32_t triangle;
    int count, x, y;
};

/// The triangles seen by one pixel's samples, in the order of the samples.
class SeenTriangles {
  public:
    SeenTriangles(const TileVisibility& visibility, std::span<const SamplePosition> pattern, int column,
                  int row) {
        for (int s = 0; s < visibility.samples; ++s) {
            const std::uint32_t triangle = visibility.at(s, column, row);
            const auto [x, y] = pattern[static_cast<std::size_t>(s)];
            std::size_t k = 0;
            while (k < size_ && seen_[k].triangle != triangle) ++k;
            if (k == size_) seen_[size_++] = {triangle, 0, 0, 0};
            ++seen_[k].count;
            seen_[k].x += x;
            seen_[k].y += y;
        }
    }
    auto begin() const { return seen_.begin(); }
    auto end() const { return seen_.begin() + size_; }
    bool is_one() const { return size_ == 1; }

  private:
    std::array<SeenTriangle, 16> seen_;
    std::size_t size_ = 0;
};

template <class Run>
bool continues(const std::vector<Run>& runs, std::uint32_t pixel, int column) {
    return column > 0 && !runs.empty() && runs.back().pixel + runs.back().count == pixel;
}

}  // namespace

void TileFragments::add_background(std::uint32_t pixel, int column, float weight) {
    if (continues(background_, pixel, column) && background_.back().weight == weight) {
        ++background_.back().count;
    } else {
        background_.push_back({pixel, 1, weight});
    }
}

void TileFragments::add_fragment(const ProjectedScene& scene, std::uint32_t triangle,
                                 const FragmentRun& fragment, int column) {
    FragmentList& list = list_of(scene, triangle);
    const std::uint32_t first = scene.first_triangle[list.object];
    const bool continues_run =
        fragment.weight == 1 && continues(list.runs, fragment.pixel, column) && list.runs.back().weight == 1;
    if (continues_run) return list.prolong(triangle, first);
    list.add(fragment, &triangle, first);
}

/// Several samples per pixel: the contribution of each triangle that the pixel's samples see.
void TileFragments::collect_samples(const ProjectedScene& scene, const TileVisibility& visibility) {
    const int samples = visibility.samples;
    const float share = 1 / static_cast<float>(samples);
    const std::span<const SamplePosition> pattern = sample_pattern(samples);

    for (int row = 0; row < visibility.height; ++row) {
        const auto top = static_cast<float>(visibility.y0 + row);
        for (int column = 0; column < visibility.width; ++column) {
            const auto pixel = static_cast<std::uint32_t>(row * visibility.stride + column);
            const auto left = static_cast<float>(visibility.x0 + column);
            const SeenTriangles seen(visibility, pattern, column, row);
            float background = 0;
            for (const SeenTriangle& s : seen) {
                const float weight = static_cast<float>(s.count) * share;
                if (s.triangle == k_no_triangle) {
                    background = weight;
                    continue;
                }
                // At the centre of the pixel or, if the triangle covers only a part of it, in the middle of
                // that part.
                const float sixteenths = 16 * static_cast<float>(s.count);
                const float x = seen.is_one() ? 0.5f : static_cast<float>(s.x) / sixteenths;
                const float y = seen.is_one() ? 0.5f : static_cast<float>(s.y) / sixteenths;
                add_fragment(scene, s.triangle,
                             {.pixel = pixel, .count = 1, .x = left + x, .y = top + y, .weight = weight},
                             column);
            }
            if (background < 1) ++pixels_seen_;
            if (background > 0 || !seen.is_one()) add_background(pixel, column, background);
        }
    }
}

}  // namespace candela
