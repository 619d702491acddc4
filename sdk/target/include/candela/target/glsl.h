// The shaders of a scene, in parts: GLSL 3.30 or GLSL ES 3.00, depending on the header.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "candela/target.h"

namespace candela::target {

/// An object's vertex shader is: header, "#define TWO_SIDED" if it is open, prelude, texture if it has one,
/// lights, its reflection model, its shading model, vertex. The fragment shader is built in the same way. The
/// others are for passes over the whole screen.
///
/// An object that textures give numbers of has "#define TEXTURED_MATERIAL" before its reflection model, and
/// its text of `materials` behind its shading model; drawn with another model than its own, its text of
/// `common_materials` in the same way, unless that is empty. One with a normal map has its text of
/// `normal_maps` there as well.
///
/// In a scene with emission, shaders read an object's emission_of() from `object_emission`; in one with
/// occlusion, ExportedObject::occlusion from `object_occlusion`.
///
/// In a scene with opacity, a fragment shader draws one layer of depth peeling: surfaces behind the depths in
/// `depth_before`, unless `is_first_layer`, where the fourth number of `covered` is below 1. It writes
/// intensity and 1, both times the opacity, which is `object_opacity`, with `object_opacity_cutoff`, or what
/// the object's text of `opacities`, after those before, reads from a texture or the vertices.
struct GlslParts {
    std::string prelude;
    std::string texture;  // empty unless an object of the scene has one
    std::string lights;
    std::vector<std::string> reflections, shadings;  // in the scene's order
    std::vector<std::string> materials;              // of objects; empty unless textures give numbers of it
    std::vector<std::string> normal_maps;            // of objects; empty unless a picture tilts its normals
    std::vector<std::string> common_materials;       // the part that any reflection model has
    std::vector<std::string> opacities;              // of objects; empty unless a texture or vertices give it
    std::string vertex, fragment;
    std::string screen, accumulate, encode;
};

/// How a fragment shader fills the depth buffer.
struct GlslDepth {
    const char* uniform;
    const char* statement;
    const char* not_behind;  // the comparison that holds of a depth at or before another
};

/// Depths grow towards the eye, from the uniform `near`; in perspective they are near / distance, which a
/// float buffer holds with the same relative precision at all distances.
extern const GlslDepth k_reversed_depth;

/// How steep normal maps are: as the scene says, or that times the uniform `normal_scale`.
enum class NormalScale : int { fixed, uniform };

/// Throws std::runtime_error if the kernels cannot be combined in one program.
GlslParts glsl_of(const ExportedScene& scene, const GlslDepth& depth = k_reversed_depth,
                  NormalScale normal_scale = NormalScale::fixed);

/// GlslParts::prelude with everything that any kernel may use, whether or not one of the scene does: for
/// kernels that are not yet known.
std::string whole_glsl_prelude();

/// Texels in a row of the texture `light_table`, from which shaders read lights. A texel has four 32-bit
/// integers (RGBA32I) and holds one member of a light's struct: the bits of a vector's three floats or of one
/// float, an integer, or the offset and size of a Table. A matrix takes three texels, its columns. In a scene
/// with shadows, a light has one more texel after its struct's members, shadow_texel().
constexpr int k_light_table_width = 1024;
/// The number of texels of a member of that type.
std::size_t texels_of(ParamType type);
/// A vector: 1 if objects block the light, otherwise 0; the rays of its ambient occlusion, and their length.
Vec3 shadow_texel(const ExportedLight& light);

/// Numbers in a row of the texture `table_numbers` (R32F), which holds ExportedScene::tables.
constexpr int k_table_width = 1024;

/// Where the lights of one model are in the table: one after the other, each with its struct's members in
/// order (KernelText::members).
struct LightBlock {
    std::string count;       // the int uniform with the number of active lights: "point_light_count"
    std::size_t lights = 0;  // capacity: the number of lights in the scene
    std::size_t first = 0;   // first texel
    std::size_t size = 0;    // texels per light
};
/// Whether a shading model of the scene reads its triangle. If so, shaders read more per vertex than the
/// first nine attributes: at locations 9 to 11 the positions of its triangle's vertices, at 12 to 14 their
/// unit normals. A target declares by TargetAbilities::triangle that it provides them.
///
/// Shaders of an object with textures read number i of them from `material_texels_<i>` (RGBA16UI, NEAREST):
/// the picture, and its mip levels in a row along its longer side, each from `longer - (longer >> (level -
/// 1))` on: below a picture that is at least as wide as high, right of others. `material_texture_<i>` has the
/// `width` and `height` of the picture, the number of `levels`, how it continues (`wrap_u`, `wrap_v`: an
/// ExportedWrap each), and i as its `unit`.
/// Where light is evaluated for each fragment, or the opacity depends on a texture, they also read the
/// positions of the triangle's vertices, as above; at location 15 how the texture coordinates change from its
/// first vertex to the second and to the third (u, v, u, v); and how the line of sight moves from pixel to
/// pixel, `pixel_right` and `pixel_up`: vectors in metres, at a distance of 1 in perspective.
///
/// In a scene with shadows they read `shadow_tree` and `least_margin`, see ShadowTree; the `object_index`;
/// `is_shadowed`, whether light is blocked on the object; the `picture_height` in pixels; `pixel_right` and
/// `pixel_up` as above; and `line_of_sight`, the line at the picture's lower left corner, to which
/// gl_FragCoord adds pixels: in perspective a direction, otherwise the distance from the eye.
bool sees_triangles(const ExportedScene& scene);

/// The blocks of the scene's light models.
std::vector<LightBlock> light_blocks(const ExportedScene& scene);

/// A picture that an object's material or normal map reads.
struct MaterialPicture {
    std::size_t texture = 0;  // index into ExportedScene::textures
    ExportedWrap wrap_u{}, wrap_v{};

    friend bool operator==(const MaterialPicture&, const MaterialPicture&) = default;
};
std::vector<MaterialPicture> material_pictures(const ExportedObject& object);
/// The largest number of them that an object has.
std::size_t most_material_pictures(const ExportedScene& scene);
/// Shaders have 16 texture units; lights, tables, shadows and passes over the screen use some.
constexpr std::size_t k_most_material_pictures = 10;

/// "face", "vertex", "fragment".
const char* rate_name(ShadingRate rate);

}  // namespace candela::target
