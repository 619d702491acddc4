// Reads a file once for all shapes that share it, as long as they exist.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "corners.h"
#include "crease.h"
#include "mesh_io/file_bytes.h"
#include "mesh_io/surface.h"
#include "origin.h"
#include "part.h"

namespace mesh {

/// A file's triangles, with properties of the whole that are computed on demand.
class Loaded {
  public:
    /// Makes them face outwards, unless `keeps_sides`.
    Loaded(mesh_io::Surface whole, bool keeps_sides);

    const mesh_io::Surface& surface() const { return surface_; }
    const Corners& corners() const { return joined().corners; }
    const OpenEdges& open() const { return joined().open; }
    const TrianglesByMaterial& by_material() const;
    /// Its vertices, split where faces meet at more than that angle (radians). Cached for one angle.
    std::shared_ptr<const SplitVertices> split(double crease_angle) const;

  private:
    struct Joined {
        Corners corners;
        OpenEdges open;
    };
    const Joined& joined() const;

    mesh_io::Surface surface_;
    // Computed on demand: parts of a file whose sides are kept need neither.
    mutable std::once_flag is_joined_, is_sorted_;
    mutable std::optional<Joined> joined_;
    mutable std::optional<TrianglesByMaterial> by_material_;
    mutable std::mutex splitting_;
    mutable std::shared_ptr<const SplitVertices> split_;
    mutable double split_angle_ = -1;
};

/// Owned by all shapes of a file.
class SharedFile {
  public:
    static std::shared_ptr<SharedFile> of(const std::string& file, const mesh_io::Origin& origin,
                                          mesh_io::FileScope reach, bool keeps_sides);

    /// The last result of `read`, unless the file or one that it names has changed since, or attributes are
    /// needed and were skipped. `read` may run on several threads at once.
    std::shared_ptr<const Loaded> loaded(mesh_io::Attributes attributes,
                                         const std::function<std::shared_ptr<const Loaded>()>& read);

  private:
    explicit SharedFile(std::string file) : file_(std::move(file)) {}

    std::string file_;
    std::mutex mutex_;
    std::shared_ptr<const Loaded> loaded_;
    mesh_io::Attributes attributes_{};        // of loaded_
    std::vector<mesh_io::FileState> states_;  // of the file and those that it names, before they were read
};

}  // namespace mesh
