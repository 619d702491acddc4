#include "plugin_picture.h"

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>

import candela.color;
import candela.diagnostics;
import candela.image;
import candela.memory;
import candela.text;

namespace {

using candela::Error;
using candela::ErrorCategory;

/// The plugin's numbers as those of a file: encoded ones as integers, intensities as floats.
class Numbers final : public candela::PictureSink {
  public:
    std::span<float> allocate(int width, int height, bool is_encoded) override {
        if (width < 1 || height < 1) throw Error(ErrorCategory::failure, "it has no pixels");
        const auto count = 3 * static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
        candela::require_memory(count * sizeof(float), "the picture");
        picture_ = {.width = width, .height = height, .is_float = !is_encoded, .values = {}};
        picture_.values.assign(count, 0);
        return picture_.values;
    }

    Picture picture() && {
        if (picture_.values.empty()) throw Error(ErrorCategory::failure, "it has no pixels");
        if (!picture_.is_float) {
            for (float& value : picture_.values) value *= Picture::k_whole;
        }
        return std::move(picture_);
    }

  private:
    Picture picture_;
};

}  // namespace

std::optional<Picture> read_by_plugin(const std::filesystem::path& file, candela::Registry& registry) {
    const candela::PluginFile* const plugin =
        registry.find_format(candela::extension_of(file), candela::FormatUse::read);
    if (plugin == nullptr) return std::nullopt;
    const std::string& name = plugin->manifest.name;
    const auto reader = registry.create<candela::ImageFormat>(
        name, registry.parameters(candela::PluginKind::image, name), candela::ColorEncoding::srgb);
    Numbers numbers;
    try {
        reader->read(file.c_str(), numbers);
        return std::move(numbers).picture();
    } catch (const std::exception& problem) {
        throw Error(ErrorCategory::failure,
                    fmt::format("'{}' cannot be read as a picture: {}", file.string(), problem.what()));
    }
}
