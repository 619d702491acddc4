module;

#include "candela/api.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// Pictures by image plugins, and what to do about a file that none of them reads or writes.
export module candela.formats;

import candela.image;
import candela.registry;

export namespace candela {

/// As an image plugin has read it.
struct DecodedPicture {
    int width = 0;                 ///< pixels, at least 1
    int height = 0;                ///< pixels, at least 1
    bool is_encoded = false;       ///< 0 .. 1, as PictureSink::allocate() says, not intensities
    std::vector<float> values;     ///< red, green, blue, interleaved, rows from the top
    std::vector<float> opacity{};  ///< of each pixel; empty: all are opaque, or nobody asked
};

/// The format that a picture's first 32 bytes tell, as an extension such as "png" or "jpg"; empty where they
/// do not tell, as in TGA files.
CANDELA_API std::string_view format_by_content(std::string_view head) noexcept;
/// The same of a file; empty for what is not a regular file, too.
CANDELA_API std::string_view format_of_content(const std::filesystem::path& file);
/// Whether two extensions are of one format, as "jpg" and "jpeg" are.
CANDELA_API bool are_one_format(std::string_view a, std::string_view b) noexcept;

/// The image plugin that reads a picture: by its content, if that tells its format, otherwise by its name;
/// null if there is none. Throws Error like Registry::find_format(). Any thread.
CANDELA_API const PluginFile* reader_of(const std::filesystem::path& file, Registry& registry);

/// Reads a picture by reader_of(); nothing if there is none. Throws Error (failure) for what the plugin
/// cannot read, and if memory is short. Any thread.
CANDELA_API std::optional<DecodedPicture> read_by_plugin(const std::filesystem::path& file,
                                                         Registry& registry, ColorEncoding encoding,
                                                         bool with_opacity = false);

/// " (possible: pnm, png)", and the package that has the other formats if its plugin is not installed. Throws
/// Error like Registry::extensions(). Any thread.
CANDELA_API std::string possible_formats(Registry& registry, FormatUse use);

}  // namespace candela
