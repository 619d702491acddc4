#include <algorithm>
#include <array>
#include <filesystem>

#include "import/import.h"

import candela.util;

namespace importing {

bool is_model(const std::filesystem::path& file) {
    constexpr std::array k_extensions = {"obj", "ply", "stl", "gltf", "glb"};
    return std::ranges::find(k_extensions, candela::extension_of(file)) != k_extensions.end();
}

}  // namespace importing
