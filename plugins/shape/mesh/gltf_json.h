// The JSON of a glTF file before tinygltf sees it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "surface.h"

namespace mesh::gltf {

struct Geometry {
    std::string json;                    // nothing but what triangles depend on
    std::vector<Loss> losses;            // what else there is
    std::vector<std::string> materials;  // their names, in order; empty where one has none
};

/// Refuses what is no JSON, is nested too deeply, or needs an extension that we do not read. `has_binary`:
/// whether the file brings the first buffer itself. Throws BadFile.
Geometry geometry_of(std::string_view json, bool has_binary);

}  // namespace mesh::gltf
