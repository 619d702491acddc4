// The shaders of a scene, in parts: GLSL 3.30 and GLSL ES 3.00, whichever the header says.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "candela/target.h"

namespace candela::target {

/// An object's vertex shader is: header, "#define TWO_SIDED" if it is open, prelude, lights, its reflection
/// model, its shading model, vertex; the fragment shader likewise. The others are of passes over the whole
/// screen.
struct GlslParts {
    std::string prelude;
    std::string lights;
    std::vector<std::string> reflections, shadings;  // as in the scene
    std::string vertex, fragment;
    std::string screen, accumulate, encode;
};

/// Throws std::runtime_error where the kernels cannot stand in one program.
GlslParts glsl_of(const ExportedScene& scene);

/// Texels in a row of the texture `light_table`, from which shaders read lights. A texel has four 32-bit
/// integers (RGBA32I) and holds a member of a light's struct: the bits of a vector's three floats, of one
/// float, an integer, or where a Table begins and its size. A matrix takes three texels, its columns.
constexpr int k_light_table_width = 1024;
/// Texels of a member of that type.
std::size_t texels_of(ParamType type);

/// Numbers in a row of the texture `table_numbers` (R32F), which holds ExportedScene::tables.
constexpr int k_table_width = 1024;

/// Where the lights of one model are in the table: one after the other, each with its struct's members in
/// their order (KernelText::members).
struct LightBlock {
    std::string count;       // the uniform, an int, of how many of them shine: "point_light_count"
    std::size_t lights = 0;  // how many there is room for: those of the scene
    std::size_t first = 0;   // the texel where they begin
    std::size_t size = 0;    // texels per light
};
/// Whether a shading model of the scene sees its triangle. If so, shaders read more of each vertex than the
/// first eight attributes: at locations 8 to 10 the positions of its triangle's vertices, at 11 to 13 their
/// unit normals. A target says that it provides them with TargetAbilities::triangle.
bool sees_triangles(const ExportedScene& scene);

/// Of each light model of the scene.
std::vector<LightBlock> light_blocks(const ExportedScene& scene);

/// "face", "vertex", "fragment".
const char* rate_name(ShadingRate rate);

}  // namespace candela::target
