module;

#include "candela/plugin/export.h"

export module candela.raster:camera;

import candela.api;

export namespace candela {

/// The observer's view. Pixel (0, 0) is top left; the centre of pixel (x, y) is at (x + 1/2, y + 1/2).
struct CANDELA_EXPORT Camera {
    Vec3 eye;
    Vec3 right, up, forward;  // orthonormal
    Projection projection = Projection::perspective;
    float pixels_per_unit = 1;  // perspective: at distance one; orthographic: per metre
    int width = 1;
    int height = 1;

    /// `size`: perspective, the full vertical angle in degrees; orthographic, the height of the view in
    /// metres.
    static Camera looking(Vec3 eye, Vec3 look_at, Vec3 up, Projection projection, float size, int width,
                          int height);

    /// The unit vector from the eye through a point of the picture, in pixels from its top left.
    Vec3 view_through(float x, float y) const;
};

}  // namespace candela
