// The interface of shape plugins.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "candela/color.h"
#include "candela/math.h"
#include "candela/plugin/descriptor.h"
#include "candela/plugin/export.h"

namespace candela {

/// A number of a vertex besides its position, normal, first texture coordinates and colour.
struct VertexChannel {
    /// As the shape names it; "uv1" has the second texture coordinates, and "color", if its numbers are more
    /// than a colour, what the file has.
    std::string_view attribute;
    std::size_t channel = 0;  // of the attribute's numbers

    friend bool operator==(const VertexChannel&, const VertexChannel&) = default;
};

/// Which optional arrays the renderer uses. A shape omits those that are not requested and those for which it
/// has no values.
struct MeshRequest {
    bool uv = false;
    bool derivatives = false;
    bool color = false;
    /// Whether normals are needed: authored ones, and the smooth groups from which shading models compute
    /// theirs. If not, the shape may share vertices wherever it can.
    bool normals = true;
    bool facets = false;                                   // whether the renderer supports a faceted mesh
    ColorEncoding color_management = ColorEncoding::srgb;  // the scene's: how colours in files are decoded
    /// Not optional: a shape without one of them throws, or has no channels.
    std::span<const VertexChannel> channels{};
};

/// Whether a shape knows its surface to be closed.
enum class Closedness : int {
    unknown,    // the host determines it
    closed,     // every edge is shared by two triangles that agree on which side is outside
    open,       // visible from both sides
    one_sided,  // visible only from the front, open or not: a room that is viewed through its walls
    convex,     // closed, and no line crosses it more than twice: it casts no shadow on itself
};

/// The arrays that a shape requests.
struct MeshLayout {
    std::size_t vertices = 0;
    std::size_t triangles = 0;
    bool has_normals = false;  // authored normals, which take precedence over those of a shading model
    bool has_uv = false;
    bool has_derivatives = false;
    bool has_color = false;
    bool has_channels = false;       // all that are requested
    bool has_smooth_groups = false;  // otherwise every vertex has its own normal
    /// Every triangle is flat: the normal at its points is its own, and its vertices, shared or not, have
    /// none. Only if facets are requested.
    bool is_faceted = false;
    Closedness closedness = Closedness::unknown;
    std::size_t open_edges = 0;  // of one_sided shapes; of open ones only if counted, otherwise the host
                                 // counts them
};

/// Arrays of the requested sizes, zero-filled; null or empty if not requested. Nothing outside them may be
/// read or written. Object space, metres.
struct MeshSpans {
    Vec3Span position;
    std::span<std::uint32_t> indices;  // three per triangle, counter-clockwise seen from outside
    Vec3Span normal;
    Vec2Span uv;
    Vec3Span dpdu;
    Vec3Span dpdv;
    std::span<std::uint32_t>
        smooth_group;  // per vertex, 0 … vertices - 1; vertices of one group share a normal
    Vec3Span color{};  // red, green, blue: intensities, 0 to 1, which multiply the object's colour
    std::span<float* const> channels{};  // an array for each of MeshRequest::channels
};

/// Receives a shape's triangles. Owned by the host; used only during tessellate().
class CANDELA_EXPORT MeshSink {
  public:
    virtual ~MeshSink();
    /// Must be called exactly once. May throw std::bad_alloc.
    virtual MeshSpans allocate(const MeshLayout& layout) = 0;
    /// Warns the user, at the object's position in the scene, about a file that is not what it claims to be.
    /// `sentence`: a whole sentence without a full stop. Call it as often as you like; equal sentences are
    /// shown once per scene.
    virtual void warn(std::string_view sentence);
    /// Reports progress in [0, 1]. Call it as often as you like, if the work may take seconds.
    virtual void progress(double fraction);
};

/// A shape with one set of parameters. Any thread.
class CANDELA_EXPORT Shape : public Instance {
  public:
    ~Shape() override;

    /// Writes the shape's triangles, centred on the origin of object space unless its parameters say
    /// otherwise. May throw std::exception if a file cannot be read.
    virtual void tessellate(const MeshRequest& request, MeshSink& sink) const = 0;
};

/// For each vertex, the first one at the same position, compared bit by bit (-0 equals 0).
CANDELA_EXPORT std::vector<std::uint32_t> welded(ConstVec3Span position, std::size_t count);

}  // namespace candela
