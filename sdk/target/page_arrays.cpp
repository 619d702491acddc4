#include "candela/target/page_arrays.h"

#include <fmt/format.h>

#include <functional>
#include <stdexcept>
#include <utility>

#include "candela/target/base64.h"
#include "candela/target/textures.h"

namespace candela::target {

std::string PageArrays::put(std::span<const std::byte> bytes) {
    const std::string_view characters(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    std::string name =
        fmt::format("array-{:x}-{:016x}", bytes.size(), std::hash<std::string_view>{}(characters));
    for (auto found = places_.find(name); found != places_.end(); found = places_.find(name)) {
        const auto [begin, size] = found->second;
        if (std::string_view(html_).substr(begin, size) == base64(bytes)) return name;
        name += "-other";
    }
    html_ += fmt::format(R"(<script type="text/plain" id="{}">)", name);
    const std::size_t begin = html_.size();
    append_base64(bytes, html_);
    places_[name] = {begin, html_.size() - begin};
    html_ += "</script>\n";
    return names_.emplace_back(std::move(name));
}

std::vector<std::string> PageArrays::put(std::span<const std::span<const float>> channels) {
    std::vector<std::string> names;
    for (const std::span<const float> channel : channels) names.push_back(put(std::as_bytes(channel)));
    return names;
}

std::vector<PageTexture> put_textures(const ExportedScene& scene, PageArrays& arrays) {
    // Browsers can read a page of a hundred megabytes, but not one of several hundred.
    constexpr std::size_t k_most_bytes = std::size_t{96} << 20;
    std::vector<PageTexture> textures;
    std::size_t bytes = 0;
    for (const ExportedTexture& texture : scene.textures) {
        const TexturePixels pixels = pixels_of(texture, scene.image.color_management);
        bytes += pixels.bytes.size();
        if (bytes > k_most_bytes)
            throw std::runtime_error(fmt::format(
                "the scene's textures take more than {} MiB, the limit of a page; make them smaller (the "
                "first beyond the limit is '{}', {} x {} pixels of {} bits)",
                k_most_bytes >> 20, texture.file, pixels.width, pixels.height, pixels.is_encoded ? 24 : 48));
        textures.push_back({.title = title_of(texture),
                            .width = pixels.width,
                            .height = pixels.height,
                            .is_encoded = pixels.is_encoded,
                            .pixels = arrays.put(pixels.bytes)});
    }
    return textures;
}

}  // namespace candela::target
