module;

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

module candela.shading;

import candela.api;

namespace candela {

namespace {

/// The texels of a row or column that one texel of the next level covers, and their weights: two, or, if
/// there is an odd one left over, three or four.
struct Cover {
    int first = 0;
    int count = 0;
    std::array<float, 4> weight{};
};

std::vector<Cover> covers_of(int count, int finer) {
    std::vector<Cover> covers(static_cast<std::size_t>(count));
    const double ratio = static_cast<double>(finer) / count;
    for (int i = 0; i < count; ++i) {
        const double begin = i * ratio, end = std::min((i + 1) * ratio, static_cast<double>(finer));
        Cover& cover = covers[static_cast<std::size_t>(i)];
        cover.first = static_cast<int>(begin);
        for (int k = cover.first; k < end && cover.count < 4; ++k) {
            const double covered = std::min(end, k + 1.0) - std::max(begin, static_cast<double>(k));
            cover.weight[static_cast<std::size_t>(cover.count++)] = static_cast<float>(covered / ratio);
        }
    }
    return covers;
}

void reduce(const MipMap::Level& from, const MipMap::Level& to, MipMap::Texels& texels) {
    const std::vector<Cover> columns = covers_of(to.width, from.width),
                             rows = covers_of(to.height, from.height);
    constexpr std::size_t k_texels = 16384;  // per task
    const auto width = static_cast<std::size_t>(to.width), finer = static_cast<std::size_t>(from.width);
    parallel_for(static_cast<std::size_t>(to.height), k_texels / width + 1,
                 [&](std::size_t begin, std::size_t end) {
                     for (std::size_t y = begin; y < end; ++y) {
                         for (std::size_t x = 0; x < width; ++x) {
                             float sum[3] = {0.5f, 0.5f, 0.5f};
                             for (int j = 0; j < rows[y].count; ++j) {
                                 const std::size_t row =
                                     from.first + static_cast<std::size_t>(rows[y].first + j) * finer;
                                 for (int i = 0; i < columns[x].count; ++i) {
                                     const float weight = rows[y].weight[static_cast<std::size_t>(j)] *
                                                          columns[x].weight[static_cast<std::size_t>(i)];
                                     const std::uint16_t* const texel =
                                         &texels[3 * (row + static_cast<std::size_t>(columns[x].first + i))];
                                     for (std::size_t c = 0; c < 3; ++c)
                                         sum[c] += weight * static_cast<float>(texel[c]);
                                 }
                             }
                             std::uint16_t* const texel = &texels[3 * (to.first + y * width + x)];
                             for (std::size_t c = 0; c < 3; ++c)
                                 texel[c] = static_cast<std::uint16_t>(std::min(sum[c], 65535.0f));
                         }
                     }
                 });
}

}  // namespace

std::vector<MipMap::Level> MipMap::levels_of(int width, int height) {
    std::vector<Level> levels;
    std::size_t first = 0;
    for (;;) {
        levels.push_back({width, height, first});
        first += static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
        if (width == 1 && height == 1) return levels;
        width = std::max(width / 2, 1);
        height = std::max(height / 2, 1);
    }
}

MipMap::Texels MipMap::room_for(int width, int height) {
    Texels texels;
    texels.reserve(3 * (levels_of(width, height).back().first + 1) + k_padding);
    texels.resize(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    return texels;
}

MipMap::MipMap(int width, int height, Texels texels)
    : levels_(levels_of(width, height)), texels_(std::move(texels)) {
    texels_.resize(3 * (levels_.back().first + 1) + k_padding);
    for (std::size_t i = 1; i < levels_.size(); ++i) reduce(levels_[i - 1], levels_[i], texels_);
    for (const Level& level : levels_) {
        sizes_.push_back(level.width);
        sizes_.push_back(level.height);
        sizes_.push_back(static_cast<std::int32_t>(level.first));
        sizes_.push_back(0);
    }
}

}  // namespace candela
