// A glTF file of one square, with pictures.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "support/gltf_file.h"

using RgbaPixel = std::array<std::uint8_t, 4>;

/// A PNG file with opacity, not compressed: at most 16,000 pixels.
std::string png(int width, int height, const std::vector<RgbaPixel>& pixels);

/// A square from (-1, -1) to (1, 1) that faces +z, or its replacement. A picture's top left is at (-1, 1).
class GltfSquare : public GltfFile {
  public:
    explicit GltfSquare(bool has_normals = true);

    Json& primitive() { return json["meshes"][0]["primitives"][0]; }
    Json& material() { return json["materials"][0]; }
    Json& pbr() { return material()["pbrMetallicRoughness"]; }

    /// A texture of its own.
    Json texture(const std::string& image);
};
