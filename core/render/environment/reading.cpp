module;

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

module candela.environment;

import candela.descriptor;
import candela.diagnostics;
import candela.formats;
import candela.image;
import candela.memory;
import candela.text;

namespace candela {

namespace {

namespace fs = std::filesystem;

class Picture final : public PictureSink {
  public:
    std::span<float> allocate(int width, int height, bool is_encoded) override {
        if (width < 1 || height < 1) throw Error(ErrorCategory::failure, "it has no pixels");
        const auto count = 3 * static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
        require_memory(count * sizeof(float), fmt::format("a picture of {} x {} pixels", width, height));
        width_ = width;
        height_ = height;
        is_encoded_ = is_encoded;
        values_.assign(count, 0);
        return values_;
    }

    Environment environment(ColorEncoding encoding) && {
        if (values_.empty()) throw Error(ErrorCategory::failure, "it has no pixels");
        const bool decode = is_encoded_ && encoding == ColorEncoding::srgb;
        for (float& value : values_) {
            if (!std::isfinite(value))
                throw Error(ErrorCategory::failure, "it has a pixel that is no finite number");
            value = std::max(decode ? srgb_to_linear(value) : value, 0.0f);
        }
        return {width_, height_, std::move(values_)};
    }

  private:
    std::vector<float> values_;
    int width_ = 0;
    int height_ = 0;
    bool is_encoded_ = false;
};

}  // namespace

Environment read_environment(const fs::path& file, Registry& registry, ColorEncoding encoding) {
    const std::string extension = extension_of(file);
    const PluginFile* const plugin = registry.find_format(extension, FormatUse::read);
    if (plugin == nullptr) {
        throw Error(ErrorCategory::failure,
                    fmt::format("'{}' is of no format that an image plugin reads{}", file.string(),
                                possible_formats(registry, FormatUse::read)));
    }
    const std::string& name = plugin->manifest.name;
    const auto reader =
        registry.create<ImageFormat>(name, registry.parameters(PluginKind::image, name), encoding);
    Picture picture;
    try {
        reader->read(file.c_str(), picture);
        return std::move(picture).environment(encoding);
    } catch (const std::exception& problem) {
        throw Error(ErrorCategory::failure,
                    fmt::format("'{}' cannot be read as a picture: {}", file.string(), problem.what()));
    }
}

}  // namespace candela
