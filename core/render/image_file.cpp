module;

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

module candela.render;

import candela.api;
import candela.plugins;
import candela.util;

namespace candela {

namespace {

namespace fs = std::filesystem;

/// Passes an image plugin's output on to a file.
class FileSink final : public ByteSink {
  public:
    explicit FileSink(OutputFile& file) : file_(file) {}
    void write(std::span<const std::byte> bytes) override { file_.write(bytes); }

  private:
    OutputFile& file_;
};

/// Like FileSink, for a regular file.
class RegularFileSink final : public RandomAccessSink {
  public:
    explicit RegularFileSink(OutputFile& file) : file_(file) {}
    void write(std::span<const std::byte> bytes) override { write_at(end_, bytes); }
    void write_at(std::uint64_t offset, std::span<const std::byte> bytes) override {
        file_.write_at(offset, bytes);
        end_ = std::max(end_, offset + bytes.size());
    }

  private:
    OutputFile& file_;
    std::uint64_t end_ = 0;
};

/// All rows of a picture, in memory.
class GatheredRows {
  public:
    GatheredRows(const ImageView& whole, ImageRows& rows) : view_(whole) {
        const std::size_t row = 3 * static_cast<std::size_t>(whole.width);
        const bool is_byte = whole.pixels == PixelType::byte;
        const std::size_t size = row * static_cast<std::size_t>(whole.height);
        require_memory(size * (is_byte ? 1 : sizeof(float)),
                       fmt::format("a picture of {} x {} pixels", whole.width, whole.height));
        if (is_byte) {
            bytes_.reserve(size);
        } else {
            reals_.reserve(size);
        }
        constexpr int k_at_once = 64;
        for (int y = 0; y < whole.height; y += k_at_once) {
            const ImageView some = rows.next(k_at_once);
            bytes_.insert(bytes_.end(), some.bytes.begin(), some.bytes.end());
            reals_.insert(reals_.end(), some.reals.begin(), some.reals.end());
        }
        view_.bytes = bytes_;
        view_.reals = reals_;
    }
    GatheredRows(const GatheredRows&) = delete;
    GatheredRows& operator=(const GatheredRows&) = delete;
    ~GatheredRows() = default;

    const ImageView& view() const { return view_; }

  private:
    ImageView view_;
    std::vector<std::uint8_t> bytes_;
    std::vector<float> reals_;
};

std::unique_ptr<ImageFormat> writer_of(const OutputFormat& format, Registry& registry,
                                       ColorEncoding encoding) {
    return registry.create<ImageFormat>(format.plugin, format.parameters, encoding);
}

/// Makes the format's plugin write, through `call`.
template <class Call>
void write(const OutputFormat& format, OutputFile& file, Registry& registry, ColorEncoding encoding,
           const Call& call) {
    const auto writer = writer_of(format, registry, encoding);
    FileSink stream(file);
    RegularFileSink regular(file);
    ByteSink& sink = file.is_random_access() ? static_cast<ByteSink&>(regular) : stream;
    try {
        call(*writer, sink);
    } catch (...) {
        rethrow_as_plugin_error(PluginKind::image, format.plugin);
    }
}

/// Writes a file in that way.
template <class Call>
void write(const OutputFormat& format, const fs::path& path, Registry& registry, Existing existing,
           ColorEncoding encoding, const Call& call) {
    OutputFile file(path, existing);
    write(format, file, registry, encoding, call);
    file.finish();
}

}  // namespace

OutputFormat format_of(const fs::path& path, Registry& registry) {
    const auto defaults = [&](std::string_view plugin) {
        return registry.parameters(PluginKind::image, plugin);
    };
    if (path == "-") {
        return {.plugin = "png",
                .extension = "png",
                .pixels = PixelType::byte,
                .has_layers = false,
                .parameters = defaults("png")};
    }
    const std::string extension = extension_of(path);
    const PluginFile* const plugin = extension.empty() ? nullptr : registry.find_format(extension);
    if (plugin == nullptr) {
        const std::vector<std::string> all = registry.extensions();
        const std::string meant = extension.empty() ? "" : suggestion(extension, all, ".");
        throw Error(
            ErrorCategory::bad_request,
            fmt::format("'{}' {}{}{}", path.string(),
                        extension.empty() ? "has no extension that names a picture format"
                                          : "has a format that no image plugin writes",
                        meant.empty() ? "" : "; " + meant, possible_formats(registry, FormatUse::write)));
    }
    const auto& formats = plugin->manifest.formats;
    const auto format =
        std::ranges::find_if(formats, [&](const ManifestFormat& f) { return f.extension == extension; });
    return {.plugin = plugin->manifest.name,
            .extension = extension,
            .pixels = format->pixels,
            .has_layers = format->layers,
            .parameters = defaults(plugin->manifest.name)};
}

void write_image(const Film& film, const OutputFormat& format, const fs::path& path, Registry& registry,
                 Existing existing, Links links) {
    OutputFile file(path, existing, links);
    write_image(film, format, file, registry);
    file.finish();
}

void write_image(const Film& film, const OutputFormat& format, OutputFile& file, Registry& registry) {
    write(format, file, registry, film.view().encoding, [&](const ImageFormat& writer, ByteSink& sink) {
        writer.write(film.view(), format.extension.c_str(), sink);
    });
}

bool can_write_rows(const OutputFormat& format, Registry& registry) {
    const auto writer = writer_of(format, registry, ColorEncoding::srgb);
    const auto* const rows = extension_of<ScanlineImageFormat>(*writer);
    return rows != nullptr && rows->writes_rows(format.extension.c_str());
}

void write_rows(const ImageView& whole, ImageRows& rows, const OutputFormat& format, const fs::path& path,
                Registry& registry, Existing existing) {
    const char* const extension = format.extension.c_str();
    write(format, path, registry, existing, whole.encoding, [&](const ImageFormat& writer, ByteSink& sink) {
        const auto* const by_rows = extension_of<ScanlineImageFormat>(writer);
        if (by_rows != nullptr && by_rows->writes_rows(extension))
            return by_rows->write_rows(whole, rows, extension, sink);
        const GatheredRows gathered(whole, rows);
        writer.write(gathered.view(), extension, sink);
    });
}

void write_layers(int width, int height, std::span<const ImageChannel> channels, const OutputFormat& format,
                  const fs::path& path, Registry& registry, Existing existing) {
    write(format, path, registry, existing, ColorEncoding::none,
          [&](const ImageFormat& writer, ByteSink& sink) {
              writer.write_layers(width, height, channels, format.extension.c_str(), sink);
          });
}

}  // namespace candela
