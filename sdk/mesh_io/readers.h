// One function per format, from bytes or a file to a surface. All throw BadFile for invalid files, check
// counts against the available bytes before they allocate, and are stateless. Text readers report progress.
// Positions are the file's, moved by `origin` while they are doubles.
#pragma once

#include <filesystem>
#include <string_view>

#include "mesh_io/file_bytes.h"
#include "mesh_io/origin.h"
#include "mesh_io/surface.h"
#include "mesh_io/text_scanner.h"

namespace mesh_io {

/// The Polygon File Format, text or binary (Turk 1994).
Surface read_ply(std::string_view bytes, const Origin& origin, const Progress& progress,
                 Attributes attributes = Attributes::skipped);

/// Stereolithography, text or binary (3D Systems 1989).
Surface read_stl(Pieces& file, const Origin& origin, const Progress& progress);

/// Wavefront OBJ: polygons, no curves. Material libraries are not opened.
Surface read_obj(std::string_view text, const Origin& origin, const Progress& progress);

/// glTF 2.0, text or binary (ISO/IEC 12113). Buffers are read from `folder`, and from elsewhere if `reach`
/// allows.
Surface read_gltf(std::string_view bytes, const Origin& origin, const std::filesystem::path& folder,
                  FileScope reach, Attributes attributes = Attributes::skipped);

}  // namespace mesh_io
