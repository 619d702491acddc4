module;

#include "candela/api.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

// Pictures by image plugins, and what to do about a file that none of them reads or writes.
export module candela.formats;

import candela.image;
import candela.registry;

export namespace candela {

/// As an image plugin has read it.
struct DecodedPicture {
    int width = 0;              ///< pixels, at least 1
    int height = 0;             ///< pixels, at least 1
    bool is_encoded = false;    ///< 0 .. 1, as PictureSink::allocate() says, not intensities
    std::vector<float> values;  ///< red, green, blue, interleaved, rows from the top
};

/// Reads a picture by the image plugin that reads files of its extension; nothing if there is none. Throws
/// Error (failure) for what the plugin cannot read, and if memory is short. Any thread.
CANDELA_API std::optional<DecodedPicture> read_by_plugin(const std::filesystem::path& file,
                                                         Registry& registry, ColorEncoding encoding);

/// " (possible: pnm, png)", and the package that has the other formats if its plugin is not installed. Throws
/// Error like Registry::extensions(). Any thread.
CANDELA_API std::string possible_formats(Registry& registry, FormatUse use);

}  // namespace candela
