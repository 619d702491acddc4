module;

#include "candela/kernel/kernel.h"
#include "candela/kernel/simd_dispatch.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <vector>

module candela.render;

import candela.api;
import candela.util;

namespace candela {

namespace kernel {

#include "candela/kernel/display.kernel"

}  // namespace kernel

namespace {

/// The curve of linear_to_srgb() (IEC 61966-2-1:1999), times 255: linear up to the limit, then a power.
constexpr float k_srgb_limit = 0.0031308f, k_srgb_slope = 255 * 12.92f;

/// sRGB's power, times 255: accurate to 0.0025, which is enough for a byte and takes a third of the work of
/// kernel::pow. x^(1/2.4) is the product of the power of x's mantissa, a polynomial (Remez exchange), and
/// that of its power of two, computed bit by bit of the exponent: for x from 2^-15 to 1.
[[gnu::always_inline]] inline float srgb_power_255(float x) {
    const auto bits = std::bit_cast<std::uint32_t>(x);
    const auto m = std::bit_cast<float>((bits & 0x007f'ffffu) | 0x3f80'0000u);  // in [1, 2)
    float p = -0.0389674716f;  // m^(1 / 2.4) * 255 * 1.055 * 2^(-15 / 2.4)
    p = p * m + 0.318831593f;
    p = p * m - 1.13408279f;
    p = p * m + 2.93843031f;
    p = p * m + 1.45054173f;
    p = (bits & 1u << 23) != 0 ? p * 1.33483985f : p;  // 2^(1 / 2.4)
    p = (bits & 1u << 24) != 0 ? p * 1.78179744f : p;  // 2^(2 / 2.4)
    p = (bits & 1u << 25) != 0 ? p * 3.17480210f : p;  // 2^(4 / 2.4)
    p = (bits & 1u << 26) != 0 ? p * 10.0793684f : p;  // 2^(8 / 2.4)
    return p - 255 * 0.055f;
}

/// Converts a channel to 8 bits: clamped, encoded, rounded. NaN becomes black.
template <bool srgb>
[[gnu::always_inline]] inline std::uint8_t byte_of(float intensity) {
    const float x = intensity > 0.0f ? (intensity < 1.0f ? intensity : 1.0f) : 0.0f;
    const float encoded = !srgb ? 255 * x : x <= k_srgb_limit ? k_srgb_slope * x : srgb_power_255(x);
    return static_cast<std::uint8_t>(static_cast<std::int32_t>(encoded + 0.5f));
}

/// Source and destination of rows of pixels, and the distance to the next row.
struct StoredRows {
    ConstVec3Span intensity;
    std::uint8_t* bytes;
    std::size_t width, height;
    std::size_t stride, pitch;
};

template <bool srgb>
struct EncodeLoop {
    CANDELA_BATCH_LOOP static void run(StoredRows rows) {
        for (std::size_t row = 0; row < rows.height; ++row) {
            const ConstVec3Span from = rows.intensity.from(row * rows.stride);
            std::uint8_t* const to = rows.bytes + row * rows.pitch;
            CANDELA_VECTORIZE_FOUR
            for (std::size_t i = 0; i < rows.width; ++i) {
                to[3 * i] = byte_of<srgb>(from.x[i]);
                to[3 * i + 1] = byte_of<srgb>(from.y[i]);
                to[3 * i + 2] = byte_of<srgb>(from.z[i]);
            }
        }
    }
};

/// Intensities before and after exposure and the tone curve.
struct TonedRow {
    ConstVec3Span intensity;
    Vec3Span toned;
    std::size_t width;
    float exposure;
};

/// Brighter than any light; beyond it, curves would compute with infinities.
constexpr float k_brightest = 1e12f;

template <ToneCurve tone>
[[gnu::always_inline]] inline kernel::vec3 toned_color(kernel::vec3 exposed) {
    if constexpr (tone == ToneCurve::khronos_neutral) return kernel::tone_khronos_neutral(exposed);
    if constexpr (tone == ToneCurve::aces) return kernel::tone_aces(exposed);
    if constexpr (tone == ToneCurve::agx) return kernel::tone_agx(exposed);
    if constexpr (tone == ToneCurve::reinhard) return kernel::tone_reinhard(exposed);
    return exposed;
}

template <ToneCurve tone>
struct ToneLoop {
    CANDELA_BATCH_LOOP static void run(TonedRow row) {
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < row.width; ++i) {
            // NaN becomes black.
            const auto exposed = [&](float x) __attribute__((always_inline)) {
                return kernel::min(kernel::max(0.0f, row.exposure * x), k_brightest);
            };
            const kernel::vec3 shown = toned_color<tone>(kernel::vec3(
                exposed(row.intensity.x[i]), exposed(row.intensity.y[i]), exposed(row.intensity.z[i])));
            row.toned.x[i] = shown.x;
            row.toned.y[i] = shown.y;
            row.toned.z[i] = shown.z;
        }
    }
};

void tone_row(const TonedRow& row, ToneCurve tone) {
    switch (tone) {
        case ToneCurve::none:
            return multiversion<ToneLoop<ToneCurve::none>>(row);
        case ToneCurve::khronos_neutral:
            return multiversion<ToneLoop<ToneCurve::khronos_neutral>>(row);
        case ToneCurve::aces:
            return multiversion<ToneLoop<ToneCurve::aces>>(row);
        case ToneCurve::agx:
            return multiversion<ToneLoop<ToneCurve::agx>>(row);
        case ToneCurve::reinhard:
            return multiversion<ToneLoop<ToneCurve::reinhard>>(row);
    }
}

void encode_toned(const StoredRows& rows, ColorEncoding encoding) {
    if (encoding == ColorEncoding::srgb) {
        multiversion<EncodeLoop<true>>(rows);
    } else {
        multiversion<EncodeLoop<false>>(rows);
    }
}

void encode(const StoredRows& rows, const DisplayTransform& transform) {
    if (transform.exposure == 1 && transform.tone == ToneCurve::none)
        return encode_toned(rows, transform.encoding);
    constexpr std::size_t k_at_once = 256;
    std::array<float, k_at_once> x{}, y{}, z{};
    const Vec3Span toned{x.data(), y.data(), z.data()};
    for (std::size_t row = 0; row < rows.height; ++row) {
        for (std::size_t first = 0; first < rows.width; first += k_at_once) {
            const std::size_t count = std::min(k_at_once, rows.width - first);
            tone_row({rows.intensity.from(row * rows.stride + first), toned, count, transform.exposure},
                     transform.tone);
            encode_toned({toned, rows.bytes + row * rows.pitch + 3 * first, count, 1, k_at_once, rows.pitch},
                         transform.encoding);
        }
    }
}

}  // namespace

Rgb toned(Rgb intensity, const DisplayTransform& transform) noexcept {
    if (transform.exposure == 1 && transform.tone == ToneCurve::none) return intensity;
    Rgb shown;
    const TonedRow one{
        {&intensity.r, &intensity.g, &intensity.b}, {&shown.r, &shown.g, &shown.b}, 1, transform.exposure};
    tone_row(one, transform.tone);
    return shown;
}

Rgb displayed(Rgb intensity, const DisplayTransform& transform) noexcept {
    const Rgb shown = toned(intensity, transform);
    const auto encoded = [&](float x) {
        const float clamped = std::clamp(x, 0.0f, 1.0f);
        return transform.encoding == ColorEncoding::srgb ? linear_to_srgb(clamped) : clamped;
    };
    return {encoded(shown.r), encoded(shown.g), encoded(shown.b)};
}

Film::Film(int width, int height, PixelType pixels, const DisplayTransform& transform)
    : Film(width, height, pixels, transform, {0, height}) {}

Film::Film(int width, int height, PixelType pixels, const DisplayTransform& transform, RowRange rows)
    : width_(width), height_(height), rows_(rows), pixels_(pixels), transform_(transform) {
    const std::size_t channels = 3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(rows.count());
    require_memory(channels * (pixels == PixelType::byte ? sizeof(std::uint8_t) : sizeof(float)),
                   fmt::format("a picture of {} x {} pixels", width, rows.count()));
    if (pixels == PixelType::byte) {
        bytes_.resize(channels);
    } else {
        reals_.resize(channels);
    }
}

std::size_t Film::index_of(int x, int y) const noexcept {
    return 3 * (static_cast<std::size_t>(y - rows_.first) * static_cast<std::size_t>(width_) +
                static_cast<std::size_t>(x));
}

void Film::fill(int x, int y, int width, int height, Rgb intensity) {
    const int first = std::max(y, rows_.first);
    height = std::min(y + height, rows_.end) - first;
    y = first;
    if (height <= 0) return;
    const float channels[3] = {intensity.r, intensity.g, intensity.b};
    std::uint8_t encoded[3];
    const StoredRows one{{&channels[0], &channels[1], &channels[2]}, &encoded[0], 1, 1, 1, 3};
    encode(one, transform_);
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
    const int first = std::max(y, rows_.first);
    intensity = intensity.from(static_cast<std::size_t>(first - y) * static_cast<std::size_t>(stride));
    height = std::min(y + height, rows_.end) - first;
    y = first;
    if (height <= 0) return;
    const std::size_t pitch = 3 * static_cast<std::size_t>(width_);
    const StoredRows rows{intensity,
                          pixels_ == PixelType::byte ? &bytes_[index_of(x, y)] : nullptr,
                          static_cast<std::size_t>(width),
                          static_cast<std::size_t>(height),
                          static_cast<std::size_t>(stride),
                          pitch};
    if (pixels_ == PixelType::byte) return encode(rows, transform_);
    for (std::size_t row = 0; row < rows.height; ++row) {
        const ConstVec3Span from = intensity.from(row * rows.stride);
        float* const to = &reals_[index_of(x, y) + row * pitch];
        for (std::size_t i = 0; i < rows.width; ++i) {
            to[3 * i] = from.x[i];
            to[3 * i + 1] = from.y[i];
            to[3 * i + 2] = from.z[i];
        }
    }
}

void Film::paste(int x, int y, const Film& other) {
    if (other.pixels_ != pixels_ || x < 0 || y < 0 || other.width_ > width_ - x ||
        other.height_ > height_ - y)
        throw std::invalid_argument("Film::paste(): the pixel types differ, or the picture does not fit");
    const auto copy = [&](const auto& from, auto& to) {
        for (int row = 0; row < other.height_; ++row) {
            std::copy_n(from.begin() + static_cast<std::ptrdiff_t>(other.index_of(0, row)), 3 * other.width_,
                        to.begin() + static_cast<std::ptrdiff_t>(index_of(x, y + row)));
        }
    };
    if (pixels_ == PixelType::byte) {
        copy(other.bytes_, bytes_);
    } else {
        copy(other.reals_, reals_);
    }
}

ImageView Film::view() const noexcept {
    return {.width = width_,
            .height = rows_.count(),
            .pixels = pixels_,
            .encoding = transform_.encoding,
            .bytes = bytes_,
            .reals = reals_};
}

}  // namespace candela
