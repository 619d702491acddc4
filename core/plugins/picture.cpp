module;

#include "candela/picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

module candela.plugins;

import candela.api;
import candela.util;

namespace candela {

namespace {

thread_local PictureAccess* current_access = nullptr;

}  // namespace

Picture read_intensities(const std::filesystem::path& file, Registry& registry, ColorEncoding encoding) {
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
    return {.width = image->width, .height = image->height, .intensity = std::move(image->values)};
}

PictureAccess::PictureAccess(Registry& registry, ColorEncoding encoding)
    : registry_(registry), encoding_(encoding), outer_(std::exchange(current_access, this)) {}

PictureAccess::~PictureAccess() { current_access = outer_; }

std::shared_ptr<const Picture> PictureAccess::read(const std::string& path) {
    std::shared_ptr<const Picture>& picture = read_[path];
    if (picture == nullptr)
        picture = std::make_shared<const Picture>(read_intensities(path, registry_, encoding_));
    return picture;
}

extern "C++" std::shared_ptr<const Picture> read_picture(const char* path) {
    if (current_access == nullptr)
        throw std::logic_error("read_picture() is called outside the creation of an instance");
    return current_access->read(path);
}

}  // namespace candela
