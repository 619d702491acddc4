// Pictures in formats that image plugins add.
#pragma once

#include <filesystem>
#include <optional>

#include "picture_comparison/picture.h"

import candela.registry;

/// Reads a picture by the image plugin that reads its extension; nothing where there is none. Throws
/// candela::Error (failure) for what the plugin cannot read.
std::optional<Picture> read_by_plugin(const std::filesystem::path& file, candela::Registry& registry);
