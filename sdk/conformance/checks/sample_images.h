// Pictures for image formats to write, and where they are written to.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

import candela.api;

/// A picture whose channels differ: red grows to the right, green downwards, smoothly enough for lossy
/// formats.
struct Image {
    int width, height;
    std::vector<float> reals;
    std::vector<std::uint8_t> bytes;

    Image(int w, int h) : width(w), height(h) {
        for (int y = 0; y < h; ++y) {
            for (int x = 0; x < w; ++x) {
                const float across = w > 1 ? static_cast<float>(x) / static_cast<float>(w - 1) : 1.0f;
                const float down = h > 16 ? static_cast<float>(y) / static_cast<float>(h - 1) : 0.5f;
                for (const float value : {across, down, 0.25f}) {
                    reals.push_back(value);
                    bytes.push_back(static_cast<std::uint8_t>(std::lround(255 * value)));
                }
            }
        }
    }

    /// One colour after another, in one row, for 1, 2, … pixels. This tests run-length encoding, including
    /// runs around the largest counts of seven and eight bits.
    static Image of_runs() {
        std::vector<std::size_t> colors;
        std::size_t run = 0;
        for (const auto& [shortest, longest] : {std::pair{1, 39}, std::pair{120, 135}, std::pair{250, 260}}) {
            for (int length = shortest; length <= longest; ++length)
                colors.insert(colors.end(), static_cast<std::size_t>(length), run++);
        }
        Image result(static_cast<int>(colors.size()), 1);
        for (std::size_t i = 0; i < result.reals.size(); ++i) {
            const float value = (colors[i / 3] >> (i % 3)) % 2 == 0 ? 0.25f : 0.75f;
            result.reals[i] = value;
            result.bytes[i] = static_cast<std::uint8_t>(std::lround(255 * value));
        }
        return result;
    }

    candela::ImageView view(candela::PixelType pixels) const {
        candela::ImageView result{
            .width = width, .height = height, .pixels = pixels, .encoding = candela::ColorEncoding::srgb};
        if (pixels == candela::PixelType::byte) {
            result.bytes = bytes;
        } else {
            result.reals = reals;
        }
        return result;
    }
    std::string size() const { return fmt::format("{} x {}", width, height); }
};

/// A picture's own channels, and others with values and names that layers have.
struct LayeredImage {
    explicit LayeredImage(const Image& picture) {
        const std::size_t pixels = picture.reals.size() / 3;
        for (std::size_t c = 0; c < 3; ++c) {
            for (std::size_t i = 0; i < pixels; ++i) planes[c].push_back(picture.reals[3 * i + c]);
        }
        planes[3].assign(pixels, std::numeric_limits<float>::infinity());
        planes[4].assign(pixels, -1.0f);
        constexpr const char* k_names[] = {"R", "G", "B", "Z", "light.l\u00e4mp 1.R"};
        for (std::size_t c = 0; c < planes.size(); ++c) channels.push_back({k_names[c], planes[c]});
    }
    std::array<std::vector<float>, 5> planes;
    std::vector<candela::ImageChannel> channels;  // refer to the planes
};

class Memory final : public candela::ByteSink {
  public:
    void write(std::span<const std::byte> written) override {
        bytes.insert(bytes.end(), written.begin(), written.end());
    }
    std::vector<std::byte> bytes;
};

inline void write_file(const std::filesystem::path& file, std::span<const std::byte> bytes) {
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}
