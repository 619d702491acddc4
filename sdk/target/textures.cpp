#include "candela/target/textures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

#include "candela/embed.h"
#include "candela/target/files.h"
#include "candela/target/literals.h"

CANDELA_EMBED(candela_target_texture_kernel, CANDELA_TARGET_TEMPLATES "/texture.kernel");
CANDELA_EMBED(candela_target_normal_map_kernel, CANDELA_TARGET_TEMPLATES "/normal_map.kernel");
CANDELA_EMBED(candela_target_texture_file, CANDELA_TARGET_TEMPLATES "/texture_file.h");

namespace candela::target {

namespace {

constexpr int k_not_encoded = -1;
constexpr const char* k_channels[] = {".x", ".y", ".z"};

/// For each intensity, the byte that decodes to it.
std::vector<int> encoded_bytes(ColorEncoding encoding) {
    std::vector<int> bytes(65536, k_not_encoded);
    for (int i = 0; i < 256; ++i) {
        const auto color = static_cast<float>(i);
        const float intensity = decoded({color, color, color}, encoding).r;
        bytes[static_cast<std::size_t>(std::lround(65535 * intensity))] = i;
    }
    return bytes;
}

}  // namespace

TexturePixels pixels_of(const ExportedTexture& texture, ColorEncoding encoding) {
    const ExportedTextureLevel& level = texture.levels.front();
    const std::vector<int> encoded = encoded_bytes(encoding);
    TexturePixels pixels{.width = level.width, .height = level.height, .is_encoded = true, .bytes = {}};
    const std::span<const std::uint16_t> texels = level.texels;
    const auto is_encoded = [&](std::uint16_t x) { return encoded[x] != k_not_encoded; };
    pixels.is_encoded = std::ranges::all_of(texels, is_encoded);
    pixels.bytes.reserve(texels.size() * (pixels.is_encoded ? 1 : 2));
    for (const std::uint16_t texel : texels) {
        if (!pixels.is_encoded) pixels.bytes.push_back(static_cast<std::byte>(texel >> 8));
        pixels.bytes.push_back(static_cast<std::byte>(pixels.is_encoded ? encoded[texel] : texel & 255));
    }
    return pixels;
}

std::string ppm_of(const TexturePixels& pixels) {
    std::string file =
        fmt::format("P6\n{} {}\n{}\n", pixels.width, pixels.height, pixels.is_encoded ? 255 : 65535);
    file.append(reinterpret_cast<const char*>(pixels.bytes.data()), pixels.bytes.size());
    return file;
}

std::string number_text(const ExportedTexturedNumber& n, const std::string& texel) {
    const auto finite = [](float x) {
        constexpr float k_largest = std::numeric_limits<float>::max();
        return float_text(std::clamp(x, -k_largest, k_largest));
    };
    const char* const channel = is_of_vertices(n) ? "" : k_channels[n.texel_channel];
    return fmt::format("number_of({}{}, {}, {}, {}, {})", texel, channel, float_text(n.scale),
                       float_text(n.offset), finite(n.minimum), finite(n.maximum));
}

MaterialStatements material_statements(
    const ExportedScene& scene, const ExportedObject& object, const MaterialNames& names,
    const std::function<std::string(const ExportedTexturedNumber&)>& lookup) {
    MaterialStatements statements;
    std::vector<std::string> lookups;
    const auto value_of = [&](const ExportedTexturedNumber& n) {
        const std::string texel = lookup(n);
        const auto known = std::ranges::find(lookups, texel);
        const auto place = known - lookups.begin();
        if (known == lookups.end()) {
            statements.texels += fmt::format("{}{}{} texel_{} = {};\n", names.indent, names.qualifier,
                                             is_of_vertices(n) ? "float" : "vec3", place, texel);
            lookups.push_back(texel);
        }
        return number_text(n, fmt::format("texel_{}", place));
    };
    if (names.has_model) {
        for (const ExportedTexturedNumber& n : object.textured_numbers) {
            const ParamSpec& parameter = scene.reflections[object.reflection].plugin->parameters[n.parameter];
            statements.assignments +=
                fmt::format("{}{}.{}{} = {};\n", names.indent, names.material, parameter.name,
                            parameter.type == ParamType::real ? "" : k_channels[n.channel], value_of(n));
        }
    }
    const auto multiply = [&](const char* name, std::span<const ExportedTexturedNumber> numbers) {
        for (const ExportedTexturedNumber& n : numbers)
            statements.common +=
                fmt::format("{}{}{} *= {};\n", names.indent, name, k_channels[n.channel], value_of(n));
    };
    multiply(names.color, object.color_numbers);
    multiply(names.emission, object.emission_numbers);
    for (const ExportedTexturedNumber& n : object.occlusion_numbers)
        statements.common += fmt::format("{}{} = {};\n", names.indent, names.occlusion, value_of(n));
    return statements;
}

bool has_color_textures(const ExportedScene& scene) {
    return std::ranges::any_of(scene.objects,
                               [](const ExportedObject& object) { return !object.color_numbers.empty(); });
}

Rgb emission_of(const ExportedObject& object, ColorEncoding encoding) {
    return object.emission_strength *
           (object.emission_numbers.empty() ? decoded(object.emission, encoding) : Rgb{1, 1, 1});
}

bool has_emission(const ExportedScene& scene) {
    return std::ranges::any_of(scene.objects, [&](const ExportedObject& object) {
        return !object.emission_numbers.empty() || emission_of(object, scene.image.color_management) != Rgb{};
    });
}

bool has_occlusion(const ExportedScene& scene) {
    return std::ranges::any_of(scene.objects, [](const ExportedObject& object) {
        return object.occlusion != 1 || !object.occlusion_numbers.empty();
    });
}

bool has_opacity(const ExportedScene& scene) {
    return std::ranges::any_of(scene.objects,
                               [](const ExportedObject& object) { return object.is_see_through(); });
}

bool has_textured_opacity(const ExportedScene& scene) {
    return std::ranges::any_of(scene.objects,
                               [](const ExportedObject& object) { return !object.opacity_numbers.empty(); });
}

bool reads_channels(const ExportedTexturedNumber& number) { return number.uv != 0 || is_of_vertices(number); }

std::optional<std::size_t> opacity_channel(const ExportedObject& object) {
    const auto number = std::ranges::find_if(object.opacity_numbers, reads_channels);
    if (number == object.opacity_numbers.end()) return std::nullopt;
    return is_of_vertices(*number) ? number->vertex_channel : 0;
}

bool has_opacity_of_channels(const ExportedScene& scene) {
    return std::ranges::any_of(
        scene.objects, [](const ExportedObject& object) { return opacity_channel(object).has_value(); });
}

std::vector<ExportedTexturedNumber> all_textured_numbers(const ExportedObject& object) {
    std::vector<ExportedTexturedNumber> all;
    for (const auto numbers :
         {object.textured_numbers, object.color_numbers, object.emission_numbers, object.occlusion_numbers})
        all.insert(all.end(), numbers.begin(), numbers.end());
    return all;
}

float value_of(const ExportedTexturedNumber& number, float given) {
    return std::min(std::max(number.offset + number.scale * given, number.minimum), number.maximum);
}

bool is_of_vertices(const ExportedTexturedNumber& number) {
    return number.vertex_channel != ExportedTexturedNumber::k_none;
}

bool needs_channels(const ExportedObject& object) {
    const auto needs = [](const ExportedTexturedNumber& n) { return n.uv != 0 || is_of_vertices(n); };
    return std::ranges::any_of(all_textured_numbers(object), needs) ||
           std::ranges::any_of(object.opacity_numbers, needs) ||
           (object.normal_map != nullptr && object.normal_map->uv != 0);
}

bool has_textured_materials(const ExportedScene& scene) {
    return !scene.textures.empty() || needs_channels(scene);
}

bool needs_channels(const ExportedScene& scene) {
    return std::ranges::any_of(scene.objects,
                               [](const ExportedObject& object) { return needs_channels(object); });
}

bool has_common_textures(const ExportedObject& object) {
    return all_textured_numbers(object).size() > object.textured_numbers.size();
}

void write_textures(const ExportedScene& scene, FileSink& files) {
    for (std::size_t i = 0; i < scene.textures.size(); ++i) {
        const TexturePixels pixels = pixels_of(scene.textures[i], scene.image.color_management);
        write(files, texture_file(i).c_str(), ppm_of(pixels));
    }
}

std::string texture_file(std::size_t number) { return fmt::format("texture_{}.ppm", number); }

std::string title_of(const ExportedTexture& texture) {
    const std::string_view file = texture.file;
    return ascii_identifier(file.substr(file.find_last_of('/') + 1));
}

bool has_normal_maps(const ExportedScene& scene) {
    return std::ranges::any_of(scene.objects,
                               [](const ExportedObject& o) { return o.normal_map != nullptr; });
}
const char* normal_function(const ExportedNormalMap& map) {
    return map.has_slopes ? "normal_from_slopes" : "normal_from_map";
}
std::string_view normal_map_kernel() { return candela_target_normal_map_kernel; }

std::string_view texture_kernel() { return candela_target_texture_kernel; }
std::string_view texture_file_source() { return candela_target_texture_file; }

}  // namespace candela::target
