// Pictures that plugins read with the host's image plugins, so that each of them knows every format.
#pragma once

#include <memory>
#include <vector>

#include "candela/plugin/export.h"

namespace candela {

/// A picture's linear intensities, finite and >= 0: three per pixel, rows from the top.
struct Picture {
    int width = 0;
    int height = 0;
    std::vector<float> intensity;
};

/// Reads a picture, only while the host creates an instance: its colours are decoded as those of the scene.
/// The second call with the same path returns the same picture. Throws std::exception if no image plugin
/// supports the format or the file is unreadable.
CANDELA_EXPORT std::shared_ptr<const Picture> read_picture(const char* path);

}  // namespace candela
