module;

#include "candela/plugin/export.h"

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// Reads and writes pictures with image plugins, and suggests what to do about unsupported formats.
export module candela.plugins:formats;

import :registry;
import candela.api;

export namespace candela {

/// A picture as an image plugin has read it.
struct DecodedImage {
    int width = 0;                 ///< pixels, at least 1
    int height = 0;                ///< pixels, at least 1
    bool is_encoded = false;       ///< 0 to 1, as ImageSink::allocate() documents, not intensities
    std::vector<float> values;     ///< red, green, blue, interleaved, rows from the top
    std::vector<float> opacity{};  ///< of each pixel; empty: all are opaque, or it was not requested
};

/// The format that a picture's first 32 bytes identify, as an extension such as "png" or "jpg"; empty if they
/// do not, as in TGA files.
CANDELA_EXPORT std::string_view format_by_content(std::string_view head) noexcept;
/// Like format_by_content(), for a file; empty if it is not a regular file.
CANDELA_EXPORT std::string_view format_of_content(const std::filesystem::path& file);
/// Whether two extensions name one format, as "jpg" and "jpeg" do.
CANDELA_EXPORT bool are_one_format(std::string_view a, std::string_view b) noexcept;

/// The image plugin that reads a picture: by its content if that identifies its format, otherwise by its
/// name; null if there is none. Throws Error like Registry::find_format(). Any thread.
CANDELA_EXPORT const PluginFile* reader_of(const std::filesystem::path& file, Registry& registry);

/// Reads a picture with the plugin of reader_of(); nothing if there is none. Throws Error (failure) if the
/// plugin cannot read it or memory is short. Any thread.
CANDELA_EXPORT std::optional<DecodedImage> read_by_plugin(const std::filesystem::path& file,
                                                          Registry& registry, ColorEncoding encoding,
                                                          bool with_opacity = false);

/// Reads a picture's linear intensities, finite and >= 0; 8-bit colours are decoded according to `encoding`.
/// Throws Error (failure) if no image plugin supports the format or the file is unreadable. Any thread.
CANDELA_EXPORT Picture read_intensities(const std::filesystem::path& file, Registry& registry,
                                        ColorEncoding encoding);

/// " (possible: pnm, png)", and the package of the other formats if their plugin is not installed. Throws
/// Error like Registry::extensions(). Any thread.
CANDELA_EXPORT std::string possible_formats(Registry& registry, FormatUse use);

}  // namespace candela

namespace candela {

/// While there is one, plugins of this thread may call read_picture(). Keeps what they read.
class PictureAccess {
  public:
    PictureAccess(Registry& registry, ColorEncoding encoding);
    ~PictureAccess();
    PictureAccess(const PictureAccess&) = delete;
    PictureAccess& operator=(const PictureAccess&) = delete;

    std::shared_ptr<const Picture> read(const std::string& path);

  private:
    Registry& registry_;
    ColorEncoding encoding_;
    PictureAccess* outer_;
    std::map<std::string, std::shared_ptr<const Picture>> read_;
};

}  // namespace candela
