module;

#include "candela/kernel.h"
#include "candela/multiversion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

module candela.film;

import candela.math;
import candela.memory;

namespace candela {

namespace {

/// One row of one channel to 8 bits: clamped, encoded, rounded. NaN counts as black.
struct EncodeLoop {
    CANDELA_BATCH_LOOP static void run(std::size_t count, const float* intensity, bool srgb,
                                       std::uint8_t* bytes) {
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) {
            const float x = intensity[i] > 0.0f ? (intensity[i] < 1.0f ? intensity[i] : 1.0f) : 0.0f;
            // IEC 61966-2-1:1999, the same curve as linear_to_srgb().
            const float curve = 1.055f * kernel::pow(x, 1 / 2.4f) - 0.055f;
            const float encoded = srgb ? (x <= 0.0031308f ? 12.92f * x : curve) : x;
            bytes[i] = static_cast<std::uint8_t>(static_cast<std::int32_t>(255.0f * encoded + 0.5f));
        }
    }
};

}  // namespace

Film::Film(int width, int height, PixelType pixels, ColorEncoding encoding)
    : width_(width), height_(height), pixels_(pixels), encoding_(encoding) {
    const std::size_t channels = 3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    require_memory(channels * (pixels == PixelType::byte ? sizeof(std::uint8_t) : sizeof(float)),
                   fmt::format("a picture of {} x {} pixels", width, height));
    if (pixels == PixelType::byte) {
        bytes_.resize(channels);
    } else {
        reals_.resize(channels);
    }
}

std::size_t Film::index_of(int x, int y) const noexcept {
    return 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x));
}

void Film::fill(int x, int y, int width, int height, Rgb intensity) {
    const float channels[3] = {intensity.r, intensity.g, intensity.b};
    std::uint8_t encoded[3];
    multiversion<EncodeLoop>(std::size_t{3}, &channels[0], encoding_ == ColorEncoding::srgb, &encoded[0]);
    const auto fill_rows = [&](auto& all, const auto& pixel) {
        const auto first = all.begin() + static_cast<std::ptrdiff_t>(index_of(x, y));
        for (int i = 0; i < width; ++i) std::copy_n(pixel, 3, first + 3 * i);
        for (int row = 1; row < height; ++row) {
            std::copy_n(first, 3 * width, all.begin() + static_cast<std::ptrdiff_t>(index_of(x, y + row)));
        }
    };
    if (pixels_ == PixelType::byte) {
        fill_rows(bytes_, encoded);
    } else {
        fill_rows(reals_, channels);
    }
}

void Film::store(int x, int y, int width, int height, ConstVec3Span intensity, int stride) {
    const auto count = static_cast<std::size_t>(width);
    std::vector<std::uint8_t> encoded(pixels_ == PixelType::byte ? 3 * count : 0);
    for (int row = 0; row < height; ++row) {
        const ConstVec3Span from =
            intensity.from(static_cast<std::size_t>(row) * static_cast<std::size_t>(stride));
        const std::size_t to = index_of(x, y + row);
        if (pixels_ == PixelType::byte) {
            const bool srgb = encoding_ == ColorEncoding::srgb;
            const float* const channels[3] = {from.x, from.y, from.z};
            for (std::size_t c = 0; c < 3; ++c) {
                multiversion<EncodeLoop>(count, channels[c], srgb, encoded.data() + c * count);
            }
            for (std::size_t i = 0; i < count; ++i) {
                for (std::size_t c = 0; c < 3; ++c) bytes_[to + 3 * i + c] = encoded[c * count + i];
            }
        } else {
            for (std::size_t i = 0; i < count; ++i) {
                reals_[to + 3 * i] = from.x[i];
                reals_[to + 3 * i + 1] = from.y[i];
                reals_[to + 3 * i + 2] = from.z[i];
            }
        }
    }
}

PictureView Film::view() const noexcept {
    return {.width = width_,
            .height = height_,
            .pixels = pixels_,
            .encoding = encoding_,
            .bytes = bytes_,
            .reals = reals_};
}

}  // namespace candela
