// One pixel of a picture: what is visible there, and how its intensity is computed.
module;

#include "candela/plugin/export.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

export module candela.render:pixel_inspector;

import :render_scene;
import candela.api;
import candela.shading;

export namespace candela {

/// The contribution of one triangle to a pixel.
struct InspectedFragment {
    std::size_t object = 0;      // index among the scene's
    std::uint32_t triangle = 0;  // of the object's mesh
    float weight = 1;       // the part of the pixel's intensity: the fraction of its samples that see the
                            // triangle, times what nearer surfaces leave of it, times its opacity
    std::size_t layer = 0;  // how many surfaces are nearer at its samples
    float opacity = 1;      // the fraction that it covers of what it is seen in
    Vec3 position{};        // of the fragment, world space
    Vec3 barycentric{};     // of the fragment, on the triangle
    ShadingRate rate = ShadingRate::fragment;
    std::vector<PointTrace> points{};  // where light is evaluated: the fragment, the face's centroid, or the
                                       // triangle's three vertices
    Vec3 intensity{};                  // of the fragment
};

struct InspectedPixel {
    std::vector<InspectedFragment> fragments{};  // in the order in which they are added up
    float background_weight = 0;                 // the part of the pixel that shows the background
    Vec3 background{};                           // its intensity
    Vec3 intensity{};                            // of the pixel
    std::array<std::uint8_t, 3> bytes{};         // of the pixel in an 8-bit picture
};

/// Inspects pixel (x, y), counted from the top left corner, of the picture that render() makes of the scene;
/// `intensity` and `bytes` are those of that picture. Throws Error like render(), and std::out_of_range if
/// the picture has no such pixel.
CANDELA_EXPORT InspectedPixel inspect_pixel(const RenderScene& scene, int x, int y);

}  // namespace candela
