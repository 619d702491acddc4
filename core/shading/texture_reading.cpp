module;

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

module candela.shading;

import :texels;
import candela.api;
import candela.plugins;
import candela.util;

namespace candela {

namespace {

constexpr float k_one = 65535;

/// Maps an encoded value, 65535 for 1, to a texel's: exact for pictures with 8 and 16 bits.
std::vector<std::uint16_t> decoding_table() {
    std::vector<std::uint16_t> table(65536);
    for (std::size_t i = 0; i < table.size(); ++i)
        table[i] =
            static_cast<std::uint16_t>(std::lround(k_one * srgb_to_linear(static_cast<float>(i) / k_one)));
    return table;
}

std::uint16_t quantized(float value) { return static_cast<std::uint16_t>(k_one * value + 0.5f); }

/// Reads a picture that has the size of a texture.
DecodedImage read_picture_of_texture(const std::filesystem::path& file, Registry& registry,
                                     ColorEncoding encoding, bool with_opacity) {
    std::optional<DecodedImage> image = read_by_plugin(file, registry, encoding, with_opacity);
    if (!image) {
        throw Error(ErrorCategory::failure,
                    fmt::format("'{}' has a format that no image plugin reads{}", file.string(),
                                possible_formats(registry, FormatUse::read)));
    }
    const auto width = static_cast<std::size_t>(image->width),
               height = static_cast<std::size_t>(image->height);
    constexpr std::size_t k_most_texels = std::size_t{1} << 30;
    if (width * height > k_most_texels) {
        throw Error(ErrorCategory::failure, fmt::format("'{}' has {} x {} pixels; a texture can have {}",
                                                        file.string(), width, height, k_most_texels));
    }
    constexpr std::size_t k_bytes = 3 * sizeof(std::uint16_t);
    require_memory(width * height * k_bytes * 4 / 3, fmt::format("the texture '{}'", file.string()));
    return *std::move(image);
}

[[noreturn]] void throw_non_finite(const std::filesystem::path& file) {
    throw Error(ErrorCategory::failure,
                fmt::format("'{}' cannot be read as a picture: a pixel is non-finite", file.string()));
}

}  // namespace

DecodedTexels read_texels(const std::filesystem::path& file, Registry& registry, ColorEncoding encoding) {
    const DecodedImage image = read_picture_of_texture(file, registry, encoding, false);
    const auto width = static_cast<std::size_t>(image.width), height = static_cast<std::size_t>(image.height);
    const bool decodes = image.is_encoded && encoding == ColorEncoding::srgb;
    const std::vector<std::uint16_t> table = decodes ? decoding_table() : std::vector<std::uint16_t>();
    MipMap::Texels texels = MipMap::room_for(image.width, image.height);
    std::atomic<bool> is_finite = true, was_clamped = false;
    constexpr std::size_t k_rows = 64;
    parallel_for(height, k_rows, [&](std::size_t begin, std::size_t end) {
        bool finite = true, clamped = false;
        for (std::size_t i = begin * width; i < end * width; ++i) {
            for (std::size_t c = 0; c < 3; ++c) {
                const float value = image.values[3 * i + c];
                finite = finite && std::isfinite(value);
                clamped = clamped || value > 1;
                const std::uint16_t whole = quantized(value > 0 ? std::min(value, 1.0f) : 0.0f);
                texels[3 * i + c] = decodes ? table[whole] : whole;
            }
        }
        if (!finite) is_finite = false;
        if (clamped) was_clamped = true;
    });
    if (!is_finite) throw_non_finite(file);
    return {image.width, image.height, std::move(texels), was_clamped};
}

TextureImage read_opacity_map(const std::filesystem::path& file, Registry& registry) {
    const DecodedImage image = read_picture_of_texture(file, registry, ColorEncoding::none, true);
    MipMap::Texels texels = MipMap::room_for(image.width, image.height);
    if (image.opacity.empty()) std::ranges::fill(texels, quantized(1));
    for (std::size_t i = 0; i < image.opacity.size(); ++i) {
        const float value = image.opacity[i];
        if (!std::isfinite(value)) throw_non_finite(file);
        std::fill_n(&texels[3 * i], 3, quantized(std::clamp(value, 0.0f, 1.0f)));
    }
    return {std::make_shared<const MipMap>(image.width, image.height, std::move(texels))};
}

TextureImage read_texture(const std::filesystem::path& file, Registry& registry, ColorEncoding encoding) {
    DecodedTexels read = read_texels(file, registry, encoding);
    return {std::make_shared<const MipMap>(read.width, read.height, std::move(read.texels)),
            read.was_clamped};
}

}  // namespace candela
