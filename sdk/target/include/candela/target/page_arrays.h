// The long arrays of a page: vertices, pictures, tables.
#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "candela/target.h"

namespace candela::target {

/// Each array is the text of its own element, and the scene's JSON has its name, which is derived from its
/// bytes. A page that shows an earlier state of the scene therefore fetches, decodes and uploads only what is
/// new to it, and equal arrays are stored once.
class PageArrays {
  public:
    /// Returns the array's name.
    std::string put(std::span<const std::byte> bytes);
    /// Returns the names of a mesh's channels.
    std::vector<std::string> put(std::span<const std::span<const float>> channels);

    /// The names of the arrays, each once, in order of insertion.
    const std::vector<std::string>& names() const { return names_; }
    /// A script element per array: its id is the name, its text base64.
    const std::string& html() const { return html_; }

  private:
    struct TextRange {
        std::size_t begin, size;  // in html_
    };

    std::vector<std::string> names_;
    std::map<std::string, TextRange> places_;
    std::string html_;
};

/// A picture whose mip levels the page computes.
struct PageTexture {
    std::string title;
    int width = 0;
    int height = 0;
    bool is_encoded = false;  // as in TexturePixels
    std::string pixels;       // the array's name
};

/// Puts the pictures of the scene's textures. Throws std::runtime_error if they are too large for a page.
std::vector<PageTexture> put_textures(const ExportedScene& scene, PageArrays& arrays);

}  // namespace candela::target
