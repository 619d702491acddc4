// A scene as plain numbers, for a rival that knows nothing of Candela. Little endian, no padding between
// members.
#pragma once

#include <cstdint>

namespace bench {

/// The file: a header, the lights, then for each object a head, its positions and normals (x y z of each
/// vertex in turn), and its corners.
struct DumpHeader {
    std::uint32_t lights = 0;
    std::uint32_t objects = 0;
    float eye[3] = {};
    float look_at[3] = {};
    float up[3] = {};
    float fov = 0;  // degrees from top to bottom
    float background[3] = {};
};

/// A point light that fades by 1/r^2.
struct DumpLight {
    float position[3] = {};
    float color[3] = {};  // times intensity
};

/// Phong's reflection model; colours and coefficients are already multiplied.
struct DumpObject {
    std::uint32_t vertices = 0;
    std::uint32_t triangles = 0;
    std::uint32_t closed = 1;  // otherwise it is seen and lit from both sides
    float diffuse[3] = {};
    float specular[3] = {};
    float shininess = 0;
};

}  // namespace bench
