// Image formats read and write nothing outside of the memory that they are given.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "checks/sample_images.h"
#include "fence.h"
#include "sandbox/temporary_folder.h"
#include "subject.h"

import candela.api;
import candela.plugins;

namespace fs = std::filesystem;
using candela::FileFormat;
using candela::ImageFormat;

namespace {

/// A picture whose pixels end, or begin, at inaccessible memory.
class FencedImage {
  public:
    FencedImage(const candela::ImageView& picture, Fence fence)
        : view_(picture),
          bytes_("bytes", picture.bytes.size(), fence),
          reals_("reals", picture.reals.size_bytes(), fence) {
        std::ranges::copy(picture.bytes, bytes_.as<std::uint8_t>());
        std::ranges::copy(picture.reals, reals_.as<float>());
        if (!picture.bytes.empty()) view_.bytes = {bytes_.as<std::uint8_t>(), picture.bytes.size()};
        if (!picture.reals.empty()) view_.reals = {reals_.as<float>(), picture.reals.size()};
    }
    const candela::ImageView& view() const { return view_; }

  private:
    candela::ImageView view_;
    Fenced bytes_, reals_;
};

/// Rows, each surrounded by inaccessible memory.
class FencedRows final : public candela::ImageRows {
  public:
    FencedRows(const candela::ImageView& picture, Fence fence) : rows_(picture), fence_(fence) {}
    candela::ImageView next(int count) override { return current_.emplace(rows_.next(count), fence_).view(); }

  private:
    candela::ViewedRows rows_;
    Fence fence_;
    std::optional<FencedImage> current_;
};

/// Memory for a picture being read.
class FencedSink final : public candela::ImageSink {
  public:
    explicit FencedSink(Fence fence) : fence_(fence) {}
    std::span<float> allocate(int width, int height, bool) override {
        const std::size_t count = 3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
        return {values_.emplace("the picture", count * sizeof(float), fence_).as<float>(), count};
    }

  private:
    Fence fence_;
    std::optional<Fenced> values_;
};

/// Reads outside a picture, its rows and its layers while a file of it is written; empty if nothing
/// is.
std::string trespass_of_writing(const ImageFormat& writer, const FileFormat& format, const Image& picture,
                                Fence fence) {
    Memory memory;
    const FencedImage whole(picture.view(format.pixels), fence);
    std::string trespass = trespass_of([&] { writer.write(whole.view(), format.extension, memory); });
    const auto* const by_rows = candela::extension_of<candela::ScanlineImageFormat>(writer);
    if (trespass.empty() && by_rows != nullptr && by_rows->writes_rows(format.extension)) {
        FencedRows rows(picture.view(format.pixels), fence);
        candela::ImageView without_pixels = picture.view(format.pixels);
        without_pixels.bytes = {};
        without_pixels.reals = {};
        trespass = trespass_of([&] { by_rows->write_rows(without_pixels, rows, format.extension, memory); });
    }
    if (!trespass.empty() || !format.layers) return trespass;
    const LayeredImage layers(picture);
    std::vector<std::unique_ptr<Fenced>> values;
    std::vector<candela::ImageChannel> channels = layers.channels;
    for (candela::ImageChannel& channel : channels) {
        const Fenced& fenced = *values.emplace_back(std::make_unique<Fenced>(
            fmt::format("channel {}", channel.name), channel.values.size_bytes(), fence));
        std::ranges::copy(channel.values, fenced.as<float>());
        channel.values = {fenced.as<float>(), channel.values.size()};
    }
    return trespass_of(
        [&] { writer.write_layers(picture.width, picture.height, channels, format.extension, memory); });
}

}  // namespace

TEST_CASE("bounds: nothing outside the picture is read, or written while a file is read", "[image]") {
    const auto plugin = make<ImageFormat>(default_values());
    const TemporaryFolder folder("candela-image-");
    for (const FileFormat& format : subject().formats) {
        for (const Image& picture : {Image(1, 1), Image(7, 5), Image(64, 48)}) {
            Memory memory;
            plugin->write(picture.view(format.pixels), format.extension, memory);
            const fs::path file = folder.path() / (std::string("picture.") + format.extension);
            write_file(file, memory.bytes);
            for (const Fence fence : {Fence::after, Fence::before}) {
                const std::string written = trespass_of_writing(*plugin, format, picture, fence);
                if (!written.empty())
                    FAIL("writing a ." << format.extension << " of " << picture.size() << ", it " << written);
                FencedSink sink(fence);
                const std::string read =
                    format.reads ? trespass_of([&] { plugin->read(file.c_str(), sink); }) : "";
                if (!read.empty())
                    FAIL("reading a ." << format.extension << " of " << picture.size() << ", it " << read);
            }
        }
    }
}
