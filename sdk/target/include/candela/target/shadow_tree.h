// The hierarchy of boxes with which programs find out whether light is blocked.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "candela/target.h"

namespace candela::target {

/// A bounding-volume hierarchy around the triangles that block light, without what a program has anyway:
/// from its meshes it takes the triangles' vertices, and from those the boxes. It is built here and not by
/// the programs, so that all of them have the same, start at once, and contain no code that builds it.
///
/// Shaders read it from `shadow_tree`, a texture (RGBA32I) with k_shadow_tree_width texels in a row;
/// positions are in it as bits of floats. First come the nodes, two texels each: the low corner of the box
/// and `nodes[2 i]`, the high corner and `nodes[2 i + 1]`. Then the triangles, three texels each: their
/// vertices, the first of them with twice the object's number, plus 1 if the object is solid (ExportedMesh),
/// and, in a scene with opacity, the second with the part of the light that it blocks, as bits of a float.
///
/// If a texture or the vertices give that, it is -1, and the third vertex has the number of a texel, after
/// the triangles, with two numbers of the first and the second corner: texture coordinates u and v, as the
/// texture places them, or the vertices' number and 0. The next texel has the third corner's and the number
/// of a texel with the scale, the offset and the cutoff of the opacity. After that, a texel has the width and
/// the height of the picture, the number of its first texel, and `wrap_u + 3 * wrap_v`; four zeros if there
/// is none. The picture follows, row by row: its channel, from 0 to 65535, of four places in a texel.
struct ShadowTree {
    /// Two numbers per node. The first: the node at which a ray goes on that misses the box, or that has met
    /// the node's triangles; -1 if there is none. The second: of a node with children -1; its first child
    /// follows it, and the other one is where the first one's first number leads. Of a leaf, eight times the
    /// first texel of its triangles, plus their number.
    std::vector<std::int32_t> nodes;
    /// For each of the objects' triangles, one object after the other, its number among those of the tree; -1
    /// if it blocks no light.
    std::vector<std::int32_t> places;
    /// How far from a surface rays must start, at least: candela::OcclusionTree::least_margin().
    float least_margin = 0;

    std::size_t triangle_count = 0;  // in the tree
};

constexpr int k_shadow_tree_width = 2048;

/// Whether an object that casts shadows blocks only a part of the light.
bool lets_light_through(const ExportedScene& scene);

/// Whether a texture, or the vertices, give the opacity of such an object.
bool has_textured_shadows(const ExportedScene& scene);
bool has_textured_shadow(const ExportedScene& scene, const ExportedObject& object);
/// Whether a texture does.
bool has_shadow_pictures(const ExportedScene& scene);

/// The middle of the box around a mesh in world space. Rays to lights from its vertices, where surfaces meet,
/// start further towards it.
Vec3 middle_of(const ExportedMesh& mesh);

/// The tree of the scene's objects that cast shadows.
ShadowTree shadow_tree(const ExportedScene& scene);

}  // namespace candela::target
