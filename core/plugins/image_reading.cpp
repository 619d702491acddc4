module;

#include "candela/large_pages.h"

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
#include <vector>

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
        resize(picture_.values, count, 0);
        return picture_.values;
    }

    std::span<float> allocate_opacity() override {
        if (with_opacity_) resize(picture_.opacity, picture_.values.size() / 3, 1);
        return picture_.opacity;
    }

    DecodedImage picture() && {
        if (picture_.values.empty()) throw Error(ErrorCategory::failure, "it has no pixels");
        return std::move(picture_);
    }

  private:
    /// Pictures are large, and are soon forgotten.
    static void resize(std::vector<float>& values, std::size_t count, float value) {
        values.clear();
        values.reserve(count);
        prefer_large_pages(values.data(), count * sizeof(float));
        values.assign(count, value);
    }

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
    const auto message_of = [&](const std::exception& problem) {
        return fmt::format("'{}' cannot be read as a picture: {}", file.string(), problem.what());
    };
    try {
        reader->read(file.c_str(), decoder);
        return std::move(decoder).picture();
    } catch (const MemoryShortage& problem) {
        throw MemoryShortage(message_of(problem));
    } catch (const std::exception& problem) {
        throw Error(ErrorCategory::failure, message_of(problem));
    }
}

}  // namespace candela
