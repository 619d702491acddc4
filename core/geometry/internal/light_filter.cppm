// Which of the hits that Embree finds block light.
module;

#include "embree_headers.h"

#include <cstdint>
#include <vector>

module candela.geometry:light_filter;

import :embree;
import :mesh;
import :occlusion_tree;

namespace candela {

/// Embree passes it to the filter with each hit of the surface.
struct Surface {
    const Mesh* mesh = nullptr;
    std::uint32_t object = 0;
    bool is_solid = false;
    bool is_transparent = false;
    bool is_see_through = false;
    bool has_inside = false;
};

/// A hit of a transparent object: rays meet its surface in pairs.
struct TransparentHit {
    std::uint32_t ray, object;
    float along;  // the ray, in multiples of its direction
    bool enters, is_near_edge;
    std::uint32_t triangle;
};

/// A hit of a see-through surface.
struct PartialHit {
    Passage passage;  // its ray: within the packet
    float along;
    bool enters, is_near_edge;
};

/// The filter's knowledge of a packet. Its beginning is Embree's own.
struct PacketContext {
    Embree::RayContext context{};
    std::uint32_t object = 0;  // on which the rays start
    bool is_one_ray = false;
    mutable std::uint32_t near_edges = 0;  // a bit for each ray that is to be traced on its own
    std::vector<TransparentHit>* hits = nullptr;
    std::vector<PartialHit>* partial_hits = nullptr;
    // The last triangle of a solid object that blocked a ray.
    mutable const Surface* blocker = nullptr;
    mutable std::uint32_t blocker_triangle = 0;
};

/// A filter for Embree: lets light pass where it leaves a solid object, or its own; and through transparent
/// ones. The hits' context is a PacketContext, their geometry's data a Surface.
void let_pass(const RTCFilterFunctionNArguments* hits);

/// Adds the ways of a packet's rays through transparent objects. `hits` is sorted and emptied.
void add_crossings(std::vector<TransparentHit>& hits, std::uint32_t first, const float* length,
                   std::vector<Crossing>& crossings);

/// Adds where a packet's rays meet see-through surfaces. `hits` is sorted and emptied.
void add_passages(std::vector<PartialHit>& hits, std::uint32_t first, std::vector<Passage>& passages);

}  // namespace candela
