#include "pigment.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "candela/color.h"
#include "candela/target/files.h"
#include "candela/target/textures.h"
#include "text.h"

namespace candela::povray_target {

namespace {

/// A texture's picture, multiplied with a colour.
target::TexturePixels image_of(const ExportedTextureLevel& level, Vec3 color) {
    target::TexturePixels pixels{
        .width = level.width, .height = level.height, .is_encoded = false, .bytes = {}};
    pixels.bytes.reserve(level.texels.size() / 4 * 6);
    const float factors[] = {color.x, color.y, color.z};
    for (std::size_t i = 0; i < level.texels.size(); ++i) {
        if (i % 4 == 3) continue;
        const long value = std::lround(factors[i % 4] * static_cast<float>(level.texels[i]));
        pixels.bytes.push_back(static_cast<std::byte>(value >> 8));
        pixels.bytes.push_back(static_cast<std::byte>(value & 255));
    }
    return pixels;
}

}  // namespace

const char* gamma_text(const ExportedScene& scene) {
    return scene.image.color_management == ColorEncoding::srgb ? "1" : "srgb";
}

Pigment pigment_of(const ExportedScene& scene, std::size_t object, Vec3 color, const char* suffix,
                   FileSink& files) {
    const ExportedObject& of = scene.objects[object];
    const float factor = std::max({color.x, color.y, color.z});
    if (of.color_texture == ExportedObject::k_no_texture || factor <= 0) return {rgb_text(color), 1};
    files.approximate("textures are seen bilinear, without averaging over a pixel's area");
    if (!of.color_texture_repeats) files.approximate("textures that are clamped at their edges are repeated");
    const std::string name = fmt::format("texture_{}{}.ppm", object, suffix);
    const ExportedTextureLevel& picture = scene.textures[of.color_texture].levels.front();
    target::write(files, name.c_str(), target::ppm_of(image_of(picture, 1 / factor * color)));
    return {
        fmt::format("uv_mapping image_map {{ ppm \"{}\" gamma {} interpolate 2 }}", name, gamma_text(scene)),
        factor};
}

}  // namespace candela::povray_target
