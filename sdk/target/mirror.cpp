#include "candela/target/mirror.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <string>

#include "candela/embed.h"
#include "candela/target/files.h"

CANDELA_EMBED(candela_target_mirror_kernel, CANDELA_TARGET_MIRROR);
CANDELA_EMBED(candela_target_radiance_kernel, CANDELA_TARGET_RADIANCE);
CANDELA_EMBED(candela_target_radiance_file, CANDELA_TARGET_TEMPLATES "/radiance_file.h");

namespace candela::target {

bool has_mirror_images(const ExportedScene& scene) {
    return std::ranges::any_of(scene.lights,
                               [](const ExportedLight& light) { return light.radiance.size > 0; });
}

bool is_mirrored(const ExportedScene& scene, std::size_t model) {
    return std::ranges::any_of(scene.lights, [&](const ExportedLight& light) {
        return light.model == model && light.radiance.size > 0;
    });
}

std::string mirror_kernel() {
    return std::string(candela_target_radiance_kernel) + "\n" + candela_target_mirror_kernel;
}
std::string_view radiance_file_source() { return candela_target_radiance_file; }

std::vector<float> radiance_texels(const ExportedScene& scene) {
    std::vector<float> all;
    for (const ExportedLight& light : scene.lights)
        all.insert(all.end(), light.radiance.texels.begin(), light.radiance.texels.end());
    return all;
}

std::size_t first_radiance_texel(const ExportedScene& scene, std::size_t light) {
    std::size_t before = 0;
    for (std::size_t i = 0; i < light; ++i) before += scene.lights[i].radiance.texels.size() / 3;
    return before;
}

int last_radiance_level(const ExportedRadianceMap& map) {
    return std::countr_zero(static_cast<unsigned>(std::max(map.size, 1)));
}

void write_radiance(const ExportedScene& scene, FileSink& files) {
    if (!has_mirror_images(scene)) return;
    std::vector<float> texels = radiance_texels(scene);
    constexpr auto k_row = std::size_t{3} * k_radiance_width;
    texels.resize((texels.size() + k_row - 1) / k_row * k_row);
    // PFM's rows are stored from the bottom.
    std::string content = fmt::format("PF\n{} {}\n-1.0\n", k_radiance_width, texels.size() / k_row);
    const std::size_t header = content.size(), row = k_row * sizeof(float);
    content.resize(header + texels.size() * sizeof(float));
    for (std::size_t y = 0; y < texels.size() / k_row; ++y)
        std::memcpy(&content[content.size() - (y + 1) * row], &texels[y * k_row], row);
    write(files, "radiance.pfm", content);
}

Vec3 radiance_place(const ExportedScene& scene, std::size_t light) {
    const ExportedRadianceMap& map = scene.lights[light].radiance;
    return {static_cast<float>(first_radiance_texel(scene, light)), static_cast<float>(map.size),
            map.density};
}

void approximate_mirror_images(const ExportedScene& scene, FileSink& files) {
    for (const ExportedLight& light : scene.lights) {
        if (light.radiance.size > 0)
            files.approximate(
                fmt::format("highlights show the samples of light {} instead of its mirror image",
                            light.label)
                    .c_str());
    }
}

}  // namespace candela::target
