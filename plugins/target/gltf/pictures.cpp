#include "pictures.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <vector>

#include "candela/target/textures.h"

namespace candela::gltf_target {

namespace {

std::string bytes_of(const char* file) {
    std::ifstream stream(file, std::ios::binary);
    if (!stream) throw std::runtime_error(fmt::format("the texture '{}' cannot be read", file));
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// Null for others.
const char* media_type(std::string_view content) {
    if (content.starts_with("\x89PNG\r\n")) return "image/png";
    return content.starts_with("\xff\xd8\xff") ? "image/jpeg" : nullptr;
}

bool is_black_or_white(const ExportedTexture& texture) {
    const std::span<const std::uint16_t> texels = texture.levels.front().texels;
    return std::ranges::all_of(texels, [](std::uint16_t x) { return x == 0 || x == 65535; });
}

/// The most significant byte first.
std::string big_endian(std::size_t number) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(number >> shift & 255u);
    return bytes;
}

void append_png_chunk(std::string& png, std::string_view type, std::string_view content) {
    const std::string checked = std::string(type) + std::string(content);
    const auto* const bytes = reinterpret_cast<const Bytef*>(checked.data());
    png += big_endian(content.size()) + checked + big_endian(::crc32_z(0, bytes, checked.size()));
}

}  // namespace

std::string png_of(int width, int height, int channels, std::span<const std::uint8_t> bytes) {
    const std::size_t row = static_cast<std::size_t>(width) * static_cast<std::size_t>(channels);
    std::vector<Bytef> filtered;
    filtered.reserve(bytes.size() + static_cast<std::size_t>(height));
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        constexpr Bytef k_up = 2;  // each byte is the difference to the one above
        if (i % row == 0) filtered.push_back(k_up);
        filtered.push_back(static_cast<Bytef>(bytes[i] - (i < row ? 0 : bytes[i - row])));
    }
    uLongf size = ::compressBound(filtered.size());
    std::string compressed(size, '\0');
    if (::compress(reinterpret_cast<Bytef*>(compressed.data()), &size, filtered.data(), filtered.size()) !=
        Z_OK)
        throw std::runtime_error("zlib could not compress a picture");
    compressed.resize(size);
    const std::string depth_and_kind =
        channels == 4 ? std::string("\x08\x06\0\0\0", 5) : std::string("\x08\x02\0\0\0", 5);
    std::string png = "\x89PNG\r\n\x1a\n";
    append_png_chunk(png, "IHDR",
                     big_endian(static_cast<std::size_t>(width)) +
                         big_endian(static_cast<std::size_t>(height)) + depth_and_kind);
    append_png_chunk(png, "IDAT", compressed);
    append_png_chunk(png, "IEND", "");
    return png;
}

std::size_t Pictures::file_of(std::size_t texture) {
    const auto known = files_.find(texture);
    if (known != files_.end()) return known->second;
    const char* const file = scene_.textures[texture].file;
    const std::string content = bytes_of(file);
    const char* const type = media_type(content);
    if (type == nullptr)
        throw std::runtime_error(fmt::format(
            "the texture '{}' is neither a PNG nor a JPEG file; glTF supports no other formats", file));
    // One picture may be two of the scene's textures, encoded like colours and linear.
    for (const auto& [other, image] : files_)
        if (std::string_view(scene_.textures[other].file) == file)
            return files_.emplace(texture, image).first->second;
    return files_.emplace(texture, add(content, type)).first->second;
}

std::optional<std::size_t> Pictures::file_of(std::size_t texture, bool is_encoded) {
    const auto [known, is_new] = alike_.try_emplace({texture, is_encoded});
    if (is_new) known->second = is_read_alike(texture, is_encoded);
    return known->second ? std::optional(file_of(texture)) : std::nullopt;
}

bool Pictures::is_read_alike(std::size_t texture, bool is_encoded) const {
    const ExportedTexture& of = scene_.textures[texture];
    std::ifstream stream(of.file, std::ios::binary);
    std::string begin(8, '\0');
    stream.read(begin.data(), static_cast<std::streamsize>(begin.size()));
    if (media_type(begin) == nullptr) return false;
    const auto fits = [&](ColorEncoding encoding) { return target::pixels_of(of, encoding).is_encoded; };
    if (of.is_opacity) return fits(ColorEncoding::none);
    const bool is_linear = fits(ColorEncoding::none), is_srgb = fits(ColorEncoding::srgb);
    if (!(is_encoded ? is_srgb : is_linear)) return false;
    // The values of few colours may be those of other bytes in the other encoding.
    return !(is_linear && is_srgb) || is_black_or_white(of);
}

std::size_t Pictures::add(std::string_view content, const char* media_type) {
    const std::size_t view = document_.add_bytes(content, ViewUse::image);
    return document_.add("images", {{"bufferView", view}, {"mimeType", media_type}});
}

std::size_t Pictures::texture_of(std::size_t image, const ExportedWrap (&wrap)[2]) {
    const auto [known, is_new] = textures_.try_emplace({image, wrap[0], wrap[1]});
    if (!is_new) return known->second;
    constexpr int k_linear = 9729, k_trilinear = 9987;
    constexpr int k_wraps[] = {10497, 33071, 33648};  // in the order of ExportedWrap
    const auto number = [&](ExportedWrap which) { return k_wraps[static_cast<std::size_t>(which)]; };
    const std::size_t sampler = document_.add("samplers", {{"magFilter", k_linear},
                                                           {"minFilter", k_trilinear},
                                                           {"wrapS", number(wrap[0])},
                                                           {"wrapT", number(wrap[1])}});
    return known->second = document_.add("textures", {{"sampler", sampler}, {"source", image}});
}

}  // namespace candela::gltf_target
