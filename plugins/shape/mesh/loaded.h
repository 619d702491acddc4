// A file that several shapes have in common is read once, while they exist.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "corners.h"
#include "file_bytes.h"
#include "origin.h"
#include "part.h"
#include "surface.h"

namespace mesh {

/// A file's triangles, with what is asked of them as a whole.
class Loaded {
  public:
    /// Turns them outwards, unless `keeps_sides`.
    Loaded(Surface whole, bool keeps_sides);

    const Surface& surface() const { return surface_; }
    const Corners& corners() const { return corners_; }
    const OpenEdges& open() const { return open_; }
    const TrianglesByMaterial& by_material() const;

  private:
    Surface surface_;
    Corners corners_;
    OpenEdges open_;
    mutable std::once_flag is_sorted_;
    mutable std::optional<TrianglesByMaterial> by_material_;
};

/// Owned by all shapes of a file.
class SharedFile {
  public:
    static std::shared_ptr<SharedFile> of(const std::string& file, const Origin& origin, Reach reach,
                                          bool keeps_sides);

    /// What `read` returned last time, unless the file, or one that it names, has changed since. `read` may
    /// run on several threads at once.
    std::shared_ptr<const Loaded> loaded(const std::function<std::shared_ptr<const Loaded>()>& read);

  private:
    explicit SharedFile(std::string file) : file_(std::move(file)) {}

    std::string file_;
    std::mutex mutex_;
    std::shared_ptr<const Loaded> loaded_;
    std::vector<FileState> states_;  // of the file and those that it names, before they were read
};

}  // namespace mesh
