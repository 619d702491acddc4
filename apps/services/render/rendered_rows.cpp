#include "render/rendered_rows.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "render/darkness_diagnosis.h"

import candela.api;
import candela.render;
import candela.scene;

namespace candela {

namespace {

/// Bands end at tile boundaries, so that no tile is rendered twice.
constexpr int k_rows_of_tiles = 64;

int rows_per_band_for(int width, PixelType pixels) {
    constexpr std::size_t k_bytes = std::size_t{1} << 26;
    const std::size_t row = 3 * static_cast<std::size_t>(width) *
                            (pixels == PixelType::byte ? sizeof(std::uint8_t) : sizeof(float));
    return static_cast<int>(std::max<std::size_t>(k_bytes / row / k_rows_of_tiles, 1)) * k_rows_of_tiles;
}

/// Rows `first` to `first + count` of a view.
template <class T>
std::span<const T> rows_of(std::span<const T> pixels, int width, int first, int count) {
    const std::size_t row = 3 * static_cast<std::size_t>(width);
    return pixels.subspan(row * static_cast<std::size_t>(first), row * static_cast<std::size_t>(count));
}

}  // namespace

RenderedRows::RenderedRows(const RenderScene& scene, PixelType pixels, RowRange rows, RenderOptions options)
    : scene_(scene),
      pixels_(pixels),
      rows_(rows),
      options_(std::move(options)),
      next_(rows.first),
      rows_per_band_(rows_per_band_for(scene.image.width, pixels)) {}

RenderedRows::~RenderedRows() = default;

void RenderedRows::render_band(int first) {
    const ImageSettings& image = scene_.image;
    const int end = std::min(first / k_rows_of_tiles * k_rows_of_tiles + rows_per_band_, rows_.end);
    band_.reset();  // frees memory before more is allocated
    band_.emplace(image.width, image.height, pixels_, display_of(scene_), RowRange{first, end});
    RenderOptions options = options_;
    if (options_.progress) {
        options.progress = [&](std::size_t done, std::size_t all) {
            options_.progress(static_cast<std::size_t>(first - rows_.first) +
                                  static_cast<std::size_t>(end - first) * done / all,
                              static_cast<std::size_t>(rows_.count()));
        };
    }
    const RenderStatistics band = renderer_.render(scene_, *band_, options);
    statistics_.triangles = band.triangles;
    statistics_.pixels_shaded += band.pixels_shaded;
    statistics_.points_lit += band.points_lit;
    statistics_.brightest = std::max(statistics_.brightest, band.brightest);
    statistics_.seconds_projecting += band.seconds_projecting;
    statistics_.seconds_on_tiles += band.seconds_on_tiles;
}

ImageView RenderedRows::next(int count) {
    const int end = next_ + std::min(count, rows_.end - next_);
    const int width = scene_.image.width;
    bytes_.clear();
    reals_.clear();
    ImageView result{
        .width = width, .height = end - next_, .pixels = pixels_, .encoding = scene_.image.color_management};
    const int first = next_;
    while (next_ < end) {
        if (!band_ || next_ >= band_->rows().end) render_band(next_);
        const RowRange rows = band_->rows();
        const int some = std::min(end, rows.end) - next_;
        const ImageView view = band_->view();
        const bool is_whole = next_ == first && some == result.height;
        if (pixels_ == PixelType::byte) {
            result.bytes = rows_of(view.bytes, width, next_ - rows.first, some);
            if (!is_whole) bytes_.insert(bytes_.end(), result.bytes.begin(), result.bytes.end());
        } else {
            result.reals = rows_of(view.reals, width, next_ - rows.first, some);
            if (!is_whole) reals_.insert(reals_.end(), result.reals.begin(), result.reals.end());
        }
        next_ += some;
    }
    if (!bytes_.empty()) result.bytes = bytes_;
    if (!reals_.empty()) result.reals = reals_;
    return result;
}

std::string RenderedRows::darkness_diagnosis() const {
    return band_ ? candela::darkness_diagnosis(scene_, *band_, statistics_) : "";
}

}  // namespace candela
