// A picture's texels before mip levels are made of them.
module;

#include <filesystem>

module candela.shading:texels;

import :texture;
import candela.api;
import candela.plugins;

namespace candela {

struct DecodedTexels {
    int width = 0, height = 0;
    MipMap::Texels texels{};   // as MipMap receives them
    bool was_clamped = false;  // as of TextureImage
};

/// The part of read_texture() that reads.
DecodedTexels read_texels(const std::filesystem::path& file, Registry& registry, ColorEncoding encoding);

}  // namespace candela
