// The content of a mesh file, whatever its format.
#pragma once

#include "candela/math.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "mesh_io/array.h"
#include "mesh_io/bad_file.h"

namespace mesh_io {

/// Vectors as three arrays of equal length.
struct Vectors {
    Array<float> x, y, z;

    std::size_t size() const { return x.size(); }
    bool empty() const { return x.empty(); }
    void resize(std::size_t count) {
        for (Array<float>* const a : {&x, &y, &z}) a->resize(count);
    }
    void push_back(candela::Vec3 v) {
        x.push_back(v.x);
        y.push_back(v.y);
        z.push_back(v.z);
    }
    candela::Vec3Span span() { return {x.data(), y.data(), z.data()}; }
    candela::ConstVec3Span span() const { return {x.data(), y.data(), z.data()}; }
};

/// A triangle whose hard edges are decided by the crease angle, not by a smoothing group.
inline constexpr std::uint32_t k_by_angle = 0xffff'ffffu;
/// A triangle that shares no normal with any other: `s off`.
inline constexpr std::uint32_t k_flat = 0;

/// A part of a file's content that a mesh leaves out.
struct Unsupported {
    /// `what` is the object of a verb: "2 materials". `is_appearance`: it concerns how the triangles are
    /// coloured and lit, which a scene can describe itself.
    Unsupported(std::string what, bool is_appearance = false)  // NOLINT(google-explicit-constructor)
        : text(std::move(what)), appearance(is_appearance) {}

    std::string text;
    bool appearance;
};

/// Numbers of a file's vertices besides those that every mesh may have.
struct Attribute {
    std::string name;  // "uv1": the second texture coordinates; "color": as the file has it, with its alpha;
                       // others as the file calls them
    std::vector<Array<float>> channels;  // each per vertex
};

/// Whether a reader reads them: a mesh that does not use them need not hold them.
enum class Attributes : bool { skipped, read };

/// The triangles of a file, on the file's vertices, in object space.
struct Surface {
    Vectors position;   // per vertex
    Vectors normal;     // per vertex, of any length, zero where the file has none; or empty
    Array<float> u, v;  // per vertex, or empty
    /// The direction of dp/du per vertex, unit, zero where the file has none or no normal; and 1 or -1, by
    /// which the cross product of normal and tangent is on the side of dp/dv. Or both empty.
    Vectors tangent;
    Array<float> tangent_side;
    Vectors color;                         // per vertex, 0 to 1 as the file has them, or empty
    std::vector<Attribute> attributes;     // if they were read
    Array<std::uint32_t> indices;          // three per triangle, < position.size()
    Vectors facet_normal;                  // per triangle, unit, zero where the file's is none; or empty
    std::vector<std::uint32_t> smoothing;  // per triangle: its smoothing group; or empty: all k_by_angle

    bool is_single = false;          // the file itself has positions in single precision
    bool are_places_unique = false;  // no two vertices are known to be at the same place
    bool is_color_linear = false;    // otherwise encoded like the colours of scenes

    std::vector<std::uint32_t> material;  // per triangle: one of the materials; or empty
    std::vector<std::string> materials;   // their names; k_no_material is that of triangles without one

    std::vector<std::filesystem::path> files;  // further files that it was read from
    std::vector<Unsupported> losses;
    std::vector<std::string> notes;  // warnings, as predicates of the file's name

    std::size_t triangles() const { return indices.size() / 3; }
};

inline constexpr const char* k_no_material = "(none)";

/// "1 line", "2 lines".
std::string counted(std::uint64_t count, std::string_view singular);

/// "a, b and c".
std::string listed(const std::vector<std::string>& items);

}  // namespace mesh_io
