module;

#include "candela/plugin/export.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

export module candela.geometry:mesh;

export import :containment;
import candela.api;
export import candela.util;

export namespace candela {

/// The attributes of a vertex that are read wherever a triangle is seen, stored contiguously: one cache line
/// instead of six.
struct alignas(32) MeshVertex {
    Vec3 position;
    float padding = 0;  // so that four floats can be fetched at once
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
    /// Further numbers, per vertex, as they were requested. With has_second_uv, the first two are the second
    /// texture coordinates.
    std::vector<AlignedVector<float>> channels;
    bool has_second_uv = false;
    bool closed = false;      // or one-sided; otherwise visible from both sides
    bool is_convex = false;   // and closed
    bool one_sided = false;   // visible only from the front, even where it is open
    bool is_faceted = false;  // the normal of a triangle's points is the triangle's; vertices have none
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

/// A mesh before it has normals, and the input from which a shading model makes them.
struct PlacedShape {
    Mesh mesh;
    Vec3Arrays authored_normal;                 // per vertex, unit, or empty
    AlignedVector<std::uint32_t> smooth_group;  // per vertex, or empty: each vertex is its own
    std::vector<std::string> warnings;          // the shape's, as sentences
};

/// Tessellates `shape` and places it in the world. `progress` receives the shape's own progress, 0 to 1.
/// Throws the shape's exceptions (std::exception), and std::invalid_argument for a mesh without triangles,
/// with an index out of range, or with a non-finite position.
CANDELA_EXPORT PlacedShape place(const Shape& shape, const MeshRequest& request, const Transform& transform,
                                 const std::function<void(double)>& progress = {});

/// Computes a mesh's face normals and the vertex normals of `shading`, with the threads that with_threads()
/// allows. Throws the shading model's exceptions.
CANDELA_EXPORT Mesh with_normals(PlacedShape placed, const ShadingModel& shading);

/// Computes only the face normals, which later calls of vertex_normals() can then reuse.
CANDELA_EXPORT void make_face_normals(Mesh& mesh);

/// The vertex normals of `shading` for a mesh that has its face normals. Throws like with_normals().
CANDELA_EXPORT Vec3Arrays vertex_normals(const PlacedShape& placed, const ShadingModel& shading);

/// place(), then with_normals().
CANDELA_EXPORT Mesh build_mesh(const Shape& shape, const MeshRequest& request, const Transform& transform,
                               const ShadingModel& shading);

}  // namespace candela
