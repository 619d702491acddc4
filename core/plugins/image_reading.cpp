module;

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <system_error>
#include <utility>

module candela.plugins;

import candela.api;
import candela.util;

namespace candela {

namespace {

class Decoder final : public ImageSink {
  public:
    explicit Decoder(bool with_opacity) : with_opacity_(with_opacity) {}

    std::span<float> allocate(int width, int height, bool is_encoded) override {
        if (width < 1 || height < 1) throw Error(ErrorCategory::failure, "it has no pixels");
        const auto count = 3 * static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
        require_memory(count * sizeof(float), fmt::format("a picture of {} x {} pixels", width, height));
        picture_ = {.width = width, .height = height, .is_encoded = is_encoded, .values = {}};
        picture_.values.assign(count, 0);
        return picture_.values;
    }

    std::span<float> allocate_opacity() override {
        if (with_opacity_) picture_.opacity.assign(picture_.values.size() / 3, 1);
        return picture_.opacity;
    }

    DecodedImage picture() && {
        if (picture_.values.empty()) throw Error(ErrorCategory::failure, "it has no pixels");
        return std::move(picture_);
    }

  private:
    bool with_opacity_;
    DecodedImage picture_;
};

}  // namespace

std::optional<DecodedImage> read_by_plugin(const std::filesystem::path& file, Registry& registry,
                                           ColorEncoding encoding, bool with_opacity) {
    const PluginFile* const plugin = reader_of(file, registry);
    if (plugin == nullptr) return std::nullopt;
    std::error_code none;
    if (std::filesystem::is_regular_file(file, none) && std::filesystem::file_size(file, none) == 0)
        throw Error(ErrorCategory::failure,
                    fmt::format("'{}' cannot be read as a picture: it is empty", file.string()));
    const std::string& name = plugin->manifest.name;
    const auto reader =
        registry.create<ImageFormat>(name, registry.parameters(PluginKind::image, name), encoding);
    Decoder decoder(with_opacity);
    try {
        reader->read(file.c_str(), decoder);
        return std::move(decoder).picture();
    } catch (const std::exception& problem) {
        throw Error(ErrorCategory::failure,
                    fmt::format("'{}' cannot be read as a picture: {}", file.string(), problem.what()));
    }
}

}  // namespace candela
