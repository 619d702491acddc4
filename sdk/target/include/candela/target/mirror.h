// Mirror images of lights from everywhere, in programs.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "candela/target.h"

namespace candela::target {

/// Whether a light of the scene has an ExportedRadianceMap.
bool has_mirror_images(const ExportedScene& scene);
/// Whether a light of that model has one, index into ExportedScene::light_models.
bool is_mirrored(const ExportedScene& scene, std::size_t model);

/// Its functions are written in the kernel language. A program must declare, before them, a struct
/// RadianceMap with a member `density`, and radiance_size(), radiance_last_level() and radiance_texel().
std::string mirror_kernel();

/// The texels of all radiance maps, one map after the other.
std::vector<float> radiance_texels(const ExportedScene& scene);
/// The number of texels before those of a light.
std::size_t first_radiance_texel(const ExportedScene& scene, std::size_t light);
/// The number of halvings of a map.
int last_radiance_level(const ExportedRadianceMap& map);

/// Writes the texels as a PFM file, for programs with radiance_file_source().
void write_radiance(const ExportedScene& scene, FileSink& files);
/// C++: `const std::vector<float>& radiance_texels()` reads that file, which is in the program's folder, in
/// the one above it, or where the source was; look_for_radiance_at(argv[0]) says where the program is.
std::string_view radiance_file_source();

/// A texel of the texture `light_table`: the first texel of the light's radiance map, its size and its
/// density. In a scene with mirror images, a light has it after its struct's members.
Vec3 radiance_place(const ExportedScene& scene, std::size_t light);
/// Texels in a row of the texture `radiance_texels` (RGB32F).
constexpr int k_radiance_width = 1024;

/// For targets without mirror images: says that samples of lights take their place.
void approximate_mirror_images(const ExportedScene& scene, FileSink& files);

}  // namespace candela::target
