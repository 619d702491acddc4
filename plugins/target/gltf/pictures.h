// Pictures in a glTF document: files as they are, and those that are made.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "candela/target.h"
#include "document.h"

namespace candela::gltf_target {

/// A PNG file of 8 bits per channel: three, or four with opacity.
std::string png_of(int width, int height, int channels, std::span<const std::uint8_t> bytes);

class Pictures {
  public:
    Pictures(const ExportedScene& scene, Document& document) : scene_(scene), document_(document) {}

    /// The image that is a texture's file. Throws std::runtime_error if it is neither a PNG nor a JPEG file.
    std::size_t file_of(std::size_t texture);
    /// The same, or nothing unless a program that reads its 8-bit channels, encoded like colours or linear,
    /// finds the values that the scene has.
    std::optional<std::size_t> file_of(std::size_t texture, bool is_encoded);
    std::size_t add(std::string_view content, const char* media_type);
    /// A texture with linear filters.
    std::size_t texture_of(std::size_t image, const ExportedWrap (&wrap)[2]);

  private:
    /// Whether a program that reads the 8-bit channels of a texture's file finds the scene's values.
    bool is_read_alike(std::size_t texture, bool is_encoded) const;

    const ExportedScene& scene_;
    Document& document_;
    std::map<std::size_t, std::size_t> files_;            // images, by the scene's texture
    std::map<std::pair<std::size_t, bool>, bool> alike_;  // by texture and whether it is encoded
    std::map<std::tuple<std::size_t, ExportedWrap, ExportedWrap>, std::size_t>
        textures_;  // by image and wrap
};

}  // namespace candela::gltf_target
