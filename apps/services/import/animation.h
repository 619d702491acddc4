// Imports animations in a scene's terms.
#pragma once

#include "import/framing.h"
#include "import/geometry.h"
#include "import/model.h"
#include "import/readers.h"
#include "import/scene_text.h"

import candela.plugins;

namespace importing {

/// Imports how a model moves, and notes the losses. First its parts, then the camera and the lights, once
/// these are chosen.
class Animator {
  public:
    Animator(Model& model, const Geometry& geometry)
        : model_(model), geometry_(geometry), all_(geometry.bounds) {}

    void take_parts(const Source& source, candela::Registry& registry);
    /// Whether a camera sees all moving parts, wherever they are.
    bool is_seen(const Camera& camera) const;
    /// `setting` already has its camera and its lights, the model's first, with their positions.
    void take_view(Setting& setting);
    void note();

    /// The bounds of everything at any time: parts, and after take_view() also the camera and lights.
    const Bounds& bounds() const { return all_; }

  private:
    void take_part(Part& part, const Bounds& box);
    void count_left_out(const Motion& motion);  // after tracks_of()
    void contain(const Vector& point);
    void contain_positions(const std::vector<Track>& tracks);

    Model& model_;
    const Geometry& geometry_;
    Bounds all_;
    std::vector<Vector> corners_;     // of the moving parts
    std::size_t budget_ = 2'000'000;  // nodes to place
    std::size_t objects_ = 0, lights_ = 0;
    bool has_camera_ = false;
};

}  // namespace importing
