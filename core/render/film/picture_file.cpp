module;

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

module candela.film;

import candela.color;
import candela.diagnostics;
import candela.files;
import candela.formats;
import candela.library;
import candela.text;

namespace candela {

namespace {

namespace fs = std::filesystem;

/// Passes what an image plugin writes on to a file.
class FileSink final : public ByteSink {
  public:
    explicit FileSink(OutputFile& file) : file_(file) {}
    void write(std::span<const std::byte> bytes) override { file_.write(bytes); }

  private:
    OutputFile& file_;
};

/// A file of what `call` makes the format's plugin write.
template <class Call>
void write(const PictureFormat& format, const fs::path& path, Registry& registry, Existing existing,
           ColorEncoding encoding, const Call& call) {
    const auto writer = registry.create<ImageFormat>(
        format.plugin, registry.parameters(PluginKind::image, format.plugin), encoding);
    OutputFile file(path, existing);
    FileSink sink(file);
    try {
        call(*writer, sink);
    } catch (...) {
        rethrow_as_plugin_error(PluginKind::image, format.plugin);
    }
    file.finish();
}

}  // namespace

PictureFormat format_of(const fs::path& path, Registry& registry) {
    if (path == "-") return {.plugin = "png", .extension = "png", .pixels = PixelType::byte};
    const std::string extension = extension_of(path);
    const PluginFile* const plugin = extension.empty() ? nullptr : registry.find_format(extension);
    if (plugin == nullptr) {
        const std::vector<std::string> all = registry.extensions();
        const std::string meant = extension.empty() ? "" : suggestion(extension, all, ".");
        throw Error(
            ErrorCategory::bad_request,
            fmt::format("'{}' {}{}{}", path.string(),
                        extension.empty() ? "has no extension that names a picture format"
                                          : "is of no format that an image plugin writes",
                        meant.empty() ? "" : "; " + meant, possible_formats(registry, FormatUse::write)));
    }
    const auto& formats = plugin->manifest.formats;
    const auto format =
        std::ranges::find_if(formats, [&](const ManifestFormat& f) { return f.extension == extension; });
    return {.plugin = plugin->manifest.name,
            .extension = extension,
            .pixels = format->pixels,
            .has_layers = format->layers};
}

void write_picture(const Film& film, const PictureFormat& format, const fs::path& path, Registry& registry,
                   Existing existing) {
    write(format, path, registry, existing, film.view().encoding,
          [&](const ImageFormat& writer, ByteSink& sink) {
              writer.write(film.view(), format.extension.c_str(), sink);
          });
}

void write_layers(int width, int height, std::span<const PictureChannel> channels,
                  const PictureFormat& format, const fs::path& path, Registry& registry, Existing existing) {
    write(format, path, registry, existing, ColorEncoding::none,
          [&](const ImageFormat& writer, ByteSink& sink) {
              writer.write_layers(width, height, channels, format.extension.c_str(), sink);
          });
}

}  // namespace candela
