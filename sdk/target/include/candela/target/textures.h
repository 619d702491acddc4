// Textures, and how programs store and look them up.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "candela/color.h"
#include "candela/target.h"

namespace candela::target {

/// A texture's picture without its mip levels, which programs compute, in the fewest bytes that hold it
/// exactly.
struct TexturePixels {
    int width = 0;
    int height = 0;
    bool is_encoded = false;  // 8 bits per channel, encoded like colours; otherwise intensities, 65535 for 1,
                              // big-endian
    std::vector<std::byte> bytes;  // red, green, blue; rows from the top
};

/// `encoding`: the scene's.
TexturePixels pixels_of(const ExportedTexture& texture, ColorEncoding encoding);

/// A PPM file (P6) with 8 or 16 bits.
std::string ppm_of(const TexturePixels& pixels);

/// Writes the pictures of the scene's textures, as PPM (P6) with 8 or 16 bits, for programs with
/// texture_file_source().
void write_textures(const ExportedScene& scene, FileSink& files);

/// The name of the file for the scene's texture of that number.
std::string texture_file(std::size_t number);

/// A texture's file name without folders, for comments.
std::string title_of(const ExportedTexture& texture);

/// Whether textures give the colour of an object of the scene.
bool has_color_textures(const ExportedScene& scene);
/// The emission of an object, as intensities; with a texture, the factor of its values.
Rgb emission_of(const ExportedObject& object, ColorEncoding encoding);
/// Whether an object of the scene emits light, or reflects less ambient light than its model says.
bool has_emission(const ExportedScene& scene);
bool has_occlusion(const ExportedScene& scene);
/// Whether something may be seen through an object of the scene.
bool has_opacity(const ExportedScene& scene);
/// Whether a texture, or the vertices, give the opacity of one.
bool has_textured_opacity(const ExportedScene& scene);
/// Whether it reads ExportedMesh::channels: it is one of them, or a texture on second texture coordinates.
bool reads_channels(const ExportedTexturedNumber& number);
/// The first of the two channels that an object's opacity depends on: 0 if it has a texture that is placed by
/// the second texture coordinates, its only one if the vertices give it; otherwise none. Of a product, those
/// of the first factor that has any.
std::optional<std::size_t> opacity_channel(const ExportedObject& object);
bool has_opacity_of_channels(const ExportedScene& scene);

/// The numbers of an object that textures give: of its own material, its colour, emission and occlusion; not
/// its opacity, which is found elsewhere.
std::vector<ExportedTexturedNumber> all_textured_numbers(const ExportedObject& object);
/// Whether a number comes from the mesh's vertices instead of a picture.
bool is_of_vertices(const ExportedTexturedNumber& number);
/// The number where its texel, 1 for white, or its channel of the vertices is `given`: within its range.
float value_of(const ExportedTexturedNumber& number, float given);
/// Whether it, or a texture placed by the second texture coordinates, needs ExportedMesh::channels.
bool needs_channels(const ExportedObject& object);
bool needs_channels(const ExportedScene& scene);
/// Whether pictures or vertices give any object numbers.
bool has_textured_materials(const ExportedScene& scene);
/// Whether textures give the object's colour, emission or occlusion, which it has with any reflection model.
bool has_common_textures(const ExportedObject& object);

/// The statements with which a program sets the numbers of an object that textures give, in C++ or GLSL:
/// look-ups of texels, each once; assignments to members of `material` by a function number_of(); and to
/// `color` and `emission`, which are factors before, and `occlusion`.
struct MaterialStatements {
    std::string texels, assignments, common;
};
struct MaterialNames {
    const char* indent;
    const char* qualifier;  // of variables: "const ", or none
    const char* material;   // the variable
    const char* color;
    const char* emission;
    const char* occlusion;
    bool has_model = true;  // otherwise without the numbers of the material
};
/// `lookup` makes the expression for the texel of a number, a vector, or for its channel of the vertices.
MaterialStatements material_statements(
    const ExportedScene& scene, const ExportedObject& object, const MaterialNames& names,
    const std::function<std::string(const ExportedTexturedNumber&)>& lookup);

/// The value of a number whose texel is `texel`, by a function number_of().
std::string number_text(const ExportedTexturedNumber& number, const std::string& texel);

/// Texture look-ups in the kernel language: the exact footprint, bilinear, trilinear. A program that uses it
/// must declare, before it, a struct ColorTexture with members `wrap_u` and `wrap_v`, and
/// color_texture_levels(), _width(), _height() and _texel().
std::string_view texture_kernel();

/// Whether a picture tilts the normals of an object.
bool has_normal_maps(const ExportedScene& scene);
/// The function of normal_map_kernel() that tilts a normal: its arguments are a texel, the two rows of
/// `to_uv`, the shading model's normal, dp/du and dp/dv.
const char* normal_function(const ExportedNormalMap& map);
/// Its functions are written in the kernel language.
std::string_view normal_map_kernel();

/// A part of a C++17 program that defines decoded(): it reads pictures from its source's folder and makes
/// their levels, texture_levels().
std::string_view texture_file_source();

}  // namespace candela::target
