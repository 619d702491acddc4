module;

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <utility>

module candela.shading;

import candela.api;
import candela.plugins;
import candela.util;

namespace candela {

EnvironmentMap read_environment(const std::filesystem::path& file, Registry& registry,
                                ColorEncoding encoding) {
    std::optional<DecodedImage> image = read_by_plugin(file, registry, encoding);
    if (!image) {
        throw Error(ErrorCategory::failure,
                    fmt::format("'{}' has a format that no image plugin reads{}", file.string(),
                                possible_formats(registry, FormatUse::read)));
    }
    const bool decode = image->is_encoded && encoding == ColorEncoding::srgb;
    for (float& value : image->values) {
        if (!std::isfinite(value)) {
            throw Error(
                ErrorCategory::failure,
                fmt::format("'{}' cannot be read as a picture: a pixel is non-finite", file.string()));
        }
        value = std::max(decode ? srgb_to_linear(value) : value, 0.0f);
    }
    return {image->width, image->height, std::move(image->values)};
}

}  // namespace candela
