module;

#include "candela/api.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

export module candela.mesh;

export import candela.arrays;
export import candela.containment;
import candela.math;
import candela.shading;
import candela.shape;
import candela.transform;

export namespace candela {

/// What is read of a vertex wherever a triangle is seen, stored contiguously: one cache line instead of six.
struct alignas(32) MeshVertex {
    Vec3 position;
    float padding = 0;  // four floats are fetched at once
    Vec3 normal;        // unit; zero if the mesh is faceted
    float more_padding = 0;
};

/// Triangles in world space. Vertices are shared; triangles are counter-clockwise seen from outside.
struct Mesh {
    Vec3Arrays position;  // for loops over all vertices
    AlignedVector<std::uint32_t> indices;
    Vec3Arrays face_normal;  // per triangle, unit; zero if it has no area
    AlignedVector<MeshVertex> vertices;
    AlignedVector<float> u, v;  // per vertex, or empty
    Vec3Arrays dpdu, dpdv;      // per vertex, or empty
    Vec3Arrays color;           // red, green, blue, 0 to 1; per vertex, or empty
    bool closed = false;        // or one-sided; otherwise visible from both sides
    bool one_sided = false;     // visible only from the front, even where it is open
    bool is_faceted = false;    // the normal of a triangle's points is the triangle's; vertices have none
    std::size_t open_edges = 0;
    Box bounds{};  // of the vertices

    inline std::size_t vertex_count() const { return position.size(); }
    inline std::size_t triangle_count() const { return indices.size() / 3; }
    inline Vec3Arrays vertex_normals() const {
        Vec3Arrays normals;
        normals.resize(vertices.size());
        for (std::size_t i = 0; i < vertices.size(); ++i) normals.span().set(i, vertices[i].normal);
        return normals;
    }
};

/// A mesh before it has normals, and the input that a shading model makes them from.
struct PlacedShape {
    Mesh mesh;
    Vec3Arrays authored_normal;                 // per vertex, unit, or empty
    AlignedVector<std::uint32_t> smooth_group;  // per vertex, or empty: each vertex is its own
    std::vector<std::string> warnings;          // of the shape, as sentences
};

/// Tessellates `shape` and places it in the world. `progress` hears what the shape says of its own: 0 … 1.
/// Throws what the shape throws (std::exception), and std::invalid_argument for a mesh without triangles,
/// with an index out of range, or with a position that is not finite.
CANDELA_API PlacedShape place(const Shape& shape, const MeshRequest& request, const Transform& transform,
                              const std::function<void(double)>& progress = {});

/// Gives a mesh its face normals and the vertex normals of `shading`, with the threads that with_threads()
/// allows. Throws what the shading model throws.
CANDELA_API Mesh with_normals(PlacedShape placed, const ShadingModel& shading);

/// Only its face normals, from which other calls of vertex_normals() need not make them.
CANDELA_API void make_face_normals(Mesh& mesh);

/// The vertex normals that `shading` gives a mesh that has its face normals. Throws as with_normals().
CANDELA_API Vec3Arrays vertex_normals(const PlacedShape& placed, const ShadingModel& shading);

/// with_normals() of place().
CANDELA_API Mesh build_mesh(const Shape& shape, const MeshRequest& request, const Transform& transform,
                            const ShadingModel& shading);

}  // namespace candela
