#include "import/images.h"

#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include "candela/file_descriptor.h"

import candela.api;
import candela.plugins;
import candela.util;

namespace fs = std::filesystem;

namespace importing {

namespace {

/// Bytes that can be read like a file while this exists.
class MemoryFile {
  public:
    explicit MemoryFile(const std::string& content) : descriptor_(::memfd_create("picture", MFD_CLOEXEC)) {
        if (!descriptor_.is_open()) fail();
        for (std::size_t at = 0; at < content.size();) {
            const ::ssize_t some = ::write(descriptor_.number(), content.data() + at, content.size() - at);
            if (some < 0 && errno == EINTR) continue;
            if (some <= 0) fail();
            at += static_cast<std::size_t>(some);
        }
    }

    fs::path path() const { return fmt::format("/proc/self/fd/{}", descriptor_.number()); }

  private:
    [[noreturn]] static void fail() {
        throw candela::Error(candela::ErrorCategory::failure, std::generic_category().message(errno));
    }

    candela::FileDescriptor descriptor_;
};

/// The reason without the file's name, because the user knows it by another.
std::string reason_of(const candela::Error& problem, const fs::path& file) {
    const std::string reason = problem.what();
    const std::string begin = fmt::format("'{}' cannot be read as a picture: ", file.string());
    return reason.starts_with(begin) ? reason.substr(begin.size()) : reason;
}

}  // namespace

ReadImage read_image(const Image& image, candela::Registry& registry) {
    std::optional<MemoryFile> memory;
    if (!image.content.empty()) memory.emplace(image.content);
    const fs::path file = memory ? memory->path() : image.file;
    std::optional<candela::DecodedImage> decoded;
    try {
        decoded =
            candela::read_by_plugin(file, registry, candela::ColorEncoding::srgb, /*with_opacity=*/true);
    } catch (const candela::MemoryShortage& problem) {
        throw candela::MemoryShortage(reason_of(problem, file));
    } catch (const candela::Error& problem) {
        throw candela::Error(candela::ErrorCategory::failure, reason_of(problem, file));
    }
    const std::string_view format = candela::format_of_content(file);
    if (!decoded)
        throw candela::Error(candela::ErrorCategory::failure,
                             fmt::format("no image plugin reads its format{}{}",
                                         format.empty() ? "" : fmt::format(", {}", format),
                                         candela::possible_formats(registry, candela::FormatUse::read)));
    if (!decoded->is_encoded &&
        !std::ranges::all_of(decoded->values, [](float value) { return std::isfinite(value); }))
        throw candela::Error(candela::ErrorCategory::failure, "it has a non-finite pixel");
    ReadImage result{.pixels = std::move(*decoded)};
    if (!format.empty() && !candela::are_one_format(format, candela::extension_of(image.file)))
        result.other_format = format;
    return result;
}

double brightness_of(const candela::DecodedImage& image) {
    // Every pixel of small pictures, some thousands of large ones.
    const std::size_t pixels = image.values.size() / 3, step = std::max<std::size_t>(pixels / 65536, 1);
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < pixels; i += step, ++count) {
        const float* const p = &image.values[3 * i];
        const float most = std::max({p[0], p[1], p[2]});
        const float linear = image.is_encoded ? candela::srgb_to_linear(std::clamp(most, 0.0f, 1.0f)) : most;
        sum += std::isfinite(linear) ? std::clamp(double{linear}, 0.0, 1.0) : 0;
    }
    return count > 0 ? sum / static_cast<double>(count) : 1;
}

Means means_of(const candela::DecodedImage& image) {
    Means means;
    // A hundred thousand or more pixels are enough for large pictures.
    constexpr std::size_t k_enough = std::size_t{1} << 18;
    const std::size_t all = image.values.size() / 3, step = all / k_enough | 1;
    const std::size_t pixels = (all + step - 1) / step;
    for (std::size_t i = 0; i < all; i += step) {
        for (std::size_t c = 0; c < 3; ++c) {
            const float value = image.values[3 * i + c];
            if (!std::isfinite(value)) continue;
            means.stored[c] += static_cast<double>(value);
            means.linear[c] += static_cast<double>(image.is_encoded ? candela::srgb_to_linear(value) : value);
        }
    }
    for (std::size_t c = 0; c < 3; ++c) {
        means.stored[c] /= static_cast<double>(pixels);
        means.linear[c] /= static_cast<double>(pixels);
    }
    for (std::size_t c = 0; c < 3; ++c) {
        bool are_equal = true;
        for (std::size_t i = 0; i < all && are_equal; ++i)
            are_equal = image.values[3 * i + c] == image.values[c];
        means.are_equal[c] = are_equal;
    }
    if (!image.opacity.empty()) {
        double sum = 0;
        for (const float value : image.opacity) sum += static_cast<double>(value);
        means.opacity = sum / static_cast<double>(all);
        means.is_opacity_equal =
            std::ranges::all_of(image.opacity, [&](float value) { return value == image.opacity.front(); });
    }
    return means;
}

}  // namespace importing
