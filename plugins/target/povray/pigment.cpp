#include "pigment.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "candela/color.h"
#include "candela/target/files.h"
#include "candela/target/textures.h"
#include "text.h"
#include "vertex_values.h"

namespace candela::povray_target {

namespace {

/// The colours that a picture gives, multiplied with another.
target::TexturePixels image_of(const ExportedTextureLevel& level,
                               std::span<const ExportedTexturedNumber> numbers, Vec3 color) {
    target::TexturePixels pixels{
        .width = level.width, .height = level.height, .is_encoded = false, .bytes = {}};
    pixels.bytes.reserve(2 * level.texels.size());
    const float factors[] = {color.x, color.y, color.z};
    for (std::size_t texel = 0; texel < level.texels.size(); texel += 3) {
        for (const ExportedTexturedNumber& n : numbers) {
            const float stored = static_cast<float>(level.texels[texel + n.texel_channel]) / 65535.0f;
            const float value = target::value_of(n, stored);
            const long whole = std::lround(65535.0f * factors[n.channel] * value);
            pixels.bytes.push_back(static_cast<std::byte>(whole >> 8));
            pixels.bytes.push_back(static_cast<std::byte>(whole & 255));
        }
    }
    return pixels;
}

/// The transform of a pattern is the inverse of that of its coordinates.
std::string transform_text(const float (&placing)[6], FileSink& files) {
    const auto& [a, b, u, c, d, v] = placing;
    if (std::ranges::equal(placing, std::array<float, 6>{1, 0, 0, 0, 1, 0})) return "";
    const float det = a * d - b * c;
    if (det == 0) {
        files.approximate("a texture that is scaled by 0 is not");
        return "";
    }
    const float a_i = d / det, b_i = -b / det, c_i = -c / det, d_i = a / det;
    return fmt::format(" matrix <{}, {}, 0, {}, {}, 0, 0, 0, 1, {}, {}, 0>", a_i, c_i, b_i, d_i,
                       -(a_i * u + b_i * v), -(c_i * u + d_i * v));
}

/// Declares in what POV-Ray's lookups of that picture differ.
void approximate_lookups(const ExportedTexturedNumber& number, FileSink& files) {
    files.approximate("textures are seen bilinear, without averaging over a pixel's area");
    for (const ExportedWrap wrap : number.wrap) {
        if (wrap == ExportedWrap::clamp)
            files.approximate("textures that are clamped at their edges are repeated");
        if (wrap == ExportedWrap::mirror)
            files.approximate("textures that are mirrored at their edges are repeated as they are");
    }
}

}  // namespace

std::string image_map_of(const ExportedScene& scene, const ExportedTexturedNumber& number,
                         const std::string& name, FileSink& files) {
    approximate_lookups(number, files);
    const std::array grey{number, number, number};
    target::write(files, name.c_str(),
                  target::ppm_of(image_of(scene.textures[number.texture].levels.front(), grey, {1, 1, 1})));
    return fmt::format("image_map {{ ppm \"{}\" gamma {} interpolate 2 }}{}", name, gamma_text(scene),
                       transform_text(number.placing, files));
}

const char* gamma_text(const ExportedScene& scene) {
    return scene.image.color_management == ColorEncoding::srgb ? "1" : "srgb";
}

Pigment pigment_of(const ExportedScene& scene, std::size_t object, Vec3 color, const char* suffix,
                   FileSink& files) {
    const ExportedObject& of = scene.objects[object];
    const float factor = std::max({color.x, color.y, color.z});
    if (!are_of_pictures(of.color_numbers) || factor <= 0) return {rgb_text(color), 1};
    const ExportedTexturedNumber& placed = of.color_numbers.front();
    approximate_lookups(placed, files);
    const std::string name = fmt::format("texture_{}{}.ppm", object, suffix);
    const ExportedTextureLevel& picture = scene.textures[placed.texture].levels.front();
    target::write(files, name.c_str(),
                  target::ppm_of(image_of(picture, of.color_numbers, 1 / factor * color)));
    return {fmt::format("uv_mapping image_map {{ ppm \"{}\" gamma {} interpolate 2 }}{}", name,
                        gamma_text(scene), transform_text(placed.placing, files)),
            factor};
}

}  // namespace candela::povray_target
