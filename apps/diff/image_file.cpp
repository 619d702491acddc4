#include "image_file.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

import candela.api;
import candela.plugins;
import candela.scene;
import candela.util;

namespace fs = std::filesystem;
using candela::Error;
using candela::ErrorCategory;

namespace {

constexpr int k_longest = 65536;  // the same as for Candela's own pictures

[[noreturn]] void fail(const fs::path& file, const std::string& what) {
    throw Error(ErrorCategory::failure, fmt::format("'{}' {}", file.string(), what));
}

void require_ordinary_file(const fs::path& file) {
    std::error_code problem;
    const fs::file_status status = fs::status(file, problem);
    if (status.type() == fs::file_type::not_found) {
        const std::string hint = candela::file_suggestion(file);
        throw Error(ErrorCategory::failure,
                    fmt::format("'{}' does not exist{}{}", file.string(), hint.empty() ? "" : "; ", hint));
    }
    if (status.type() == fs::file_type::none)
        fail(file, fmt::format("cannot be examined: {}", problem.message()));
    if (status.type() == fs::file_type::directory) fail(file, "is a directory; expected a picture file");
    if (status.type() != fs::file_type::regular) fail(file, "is not a regular file (a pipe or a device?)");
    if (::access(file.c_str(), R_OK) != 0)
        fail(file, fmt::format("cannot be opened: {}", std::strerror(errno)));
}

/// OpenImageIO's message, on one line.
std::string reason(std::string text) {
    while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())) != 0) text.pop_back();
    std::ranges::replace(text, '\n', ' ');
    return text.empty() ? "it may be truncated" : text;
}

struct Window {
    int x = 0, y = 0, width = 0, height = 0;
};

/// The visible part of the picture: an EXR file may store less of it, or more.
Window shown_window(const OIIO::ImageSpec& spec) {
    if (spec.full_width < 1 || spec.full_height < 1) return {spec.x, spec.y, spec.width, spec.height};
    return {spec.full_x, spec.full_y, spec.full_width, spec.full_height};
}

/// All stored pixels of the first `channels` channels.
template <class Number>
std::vector<Number> stored(OIIO::ImageInput& input, const fs::path& file, int channels, OIIO::TypeDesc type) {
    const OIIO::ImageSpec& spec = input.spec();
    std::vector<Number> numbers(static_cast<std::size_t>(channels) * static_cast<std::size_t>(spec.width) *
                                static_cast<std::size_t>(spec.height));
    if (!input.read_image(0, 0, 0, channels, type, numbers.data()))
        fail(file, fmt::format("cannot be read: {}", reason(input.geterror())));
    return numbers;
}

template <class Number>
void place(const std::vector<Number>& numbers, const OIIO::ImageSpec& spec, const Window& shown, int channels,
           Image& image) {
    const int left = std::max(spec.x, shown.x), right = std::min(spec.x + spec.width, shown.x + shown.width);
    const int top = std::max(spec.y, shown.y),
              bottom = std::min(spec.y + spec.height, shown.y + shown.height);
    for (int y = top; y < bottom; ++y) {
        for (int x = left; x < right; ++x) {
            const auto from = static_cast<std::size_t>(y - spec.y) * static_cast<std::size_t>(spec.width) +
                              static_cast<std::size_t>(x - spec.x);
            const auto to = static_cast<std::size_t>(y - shown.y) * static_cast<std::size_t>(shown.width) +
                            static_cast<std::size_t>(x - shown.x);
            for (std::size_t c = 0; c < 3; ++c) {
                image.values[3 * to + c] = static_cast<float>(
                    numbers[static_cast<std::size_t>(channels) * from + (channels == 3 ? c : 0)]);
            }
        }
    }
}

void require_finite(const Image& image, const fs::path& file) {
    const auto wrong = std::ranges::find_if_not(image.values, [](float v) { return std::isfinite(v); });
    if (wrong == image.values.end()) return;
    constexpr std::array<std::string_view, 3> k_colors = {"red", "green", "blue"};
    const auto index = static_cast<std::size_t>(wrong - image.values.begin());
    const auto width = static_cast<std::size_t>(image.width);
    fail(file, fmt::format("contains {} at x {}, y {} ({}), counted from 0 at the upper left; only finite "
                           "numbers can be compared",
                           std::isnan(*wrong) ? "NaN" : "infinity", index / 3 % width, index / 3 / width,
                           k_colors[index % 3]));
}

/// Whether OpenImageIO has a reader for that extension.
bool has_reader(const std::string& extension) {
    return std::ranges::any_of(OIIO::get_extension_map(), [&](const auto& format) {
        return std::ranges::find(format.second, extension) != format.second.end();
    });
}

/// Nothing if OpenImageIO cannot read it; `problem` is the reason.
std::optional<Image> read_by_openimageio(const fs::path& file, std::string& problem) {
    // Otherwise colours would be multiplied with alpha, which is not compared.
    OIIO::ImageSpec wishes;
    wishes.attribute("oiio:UnassociatedAlpha", 1);
    const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(file.string(), &wishes);
    if (input == nullptr) {
        problem = reason(OIIO::geterror());
        return std::nullopt;
    }
    const OIIO::ImageSpec& spec = input->spec();
    const Window shown = shown_window(spec);
    if (spec.deep || spec.depth > 1 || spec.nchannels < 1)
        fail(file, "is not a flat picture (it is deep, a volume, or without channels)");
    for (const int length : {spec.width, spec.height, shown.width, shown.height}) {
        if (length < 1 || length > k_longest) {
            fail(file, fmt::format("has {} x {} pixels; expected 1 to {} each way", shown.width, shown.height,
                                   k_longest));
        }
    }

    Image image{.width = shown.width,
                .height = shown.height,
                .is_float = spec.format.is_floating_point(),
                .values = {}};
    const int channels = spec.nchannels < 3 ? 1 : 3;  // two channels are grey and alpha
    const std::uint64_t bytes = sizeof(float) * 3 * (image.pixels() + spec.image_pixels());
    candela::require_memory(bytes, fmt::format("the picture '{}'", file.string()));
    image.values.resize(3 * image.pixels());
    if (image.is_float) {
        place(stored<float>(*input, file, channels, OIIO::TypeFloat), spec, shown, channels, image);
    } else {
        place(stored<std::uint16_t>(*input, file, channels, OIIO::TypeUInt16), spec, shown, channels, image);
    }
    return image;
}

/// Converts the plugin's values to a file's: encoded ones to integers, intensities to floats. Nothing if no
/// image plugin reads files of that extension.
std::optional<Image> read_by_plugin(const fs::path& file, candela::Registry& registry) {
    auto decoded = candela::read_by_plugin(file, registry, candela::ColorEncoding::srgb);
    if (!decoded) return std::nullopt;
    Image image{.width = decoded->width,
                .height = decoded->height,
                .is_float = !decoded->is_encoded,
                .values = std::move(decoded->values)};
    if (!image.is_float) {
        for (float& value : image.values) value *= Image::k_whole;
    }
    return image;
}

}  // namespace

Image read_image(const fs::path& file, candela::Registry& registry) {
    require_ordinary_file(file);
    std::string problem;
    auto image = read_by_openimageio(file, problem);
    if (!image && !has_reader(candela::extension_of(file))) image = read_by_plugin(file, registry);
    if (!image) fail(file, fmt::format("is not a picture: {}", problem));
    require_finite(*image, file);
    return *std::move(image);
}
