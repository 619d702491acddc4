module;

#include <optional>

module candela.scene:animating;

import :animation;
import :request;
import :tables;
import :toml;

namespace candela {

/// Reads [animation], without the tracks that `request` overrides. Nothing if the scene has none, or if it
/// has errors, which are reported.
std::optional<Animation> read_animation(SceneTables& tables, const SceneRequest& request);

/// A document as of one frame.
TableNode at_frame(const TableNode& root, const Animation& animation, int frame);

}  // namespace candela
