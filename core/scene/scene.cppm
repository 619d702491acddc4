// A scene: read from files, validated, immutable.
module;

#include "candela/plugin/export.h"

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

export module candela.scene;

export import :animation;
export import :content;
export import :document;
export import :request;
export import :schema;
export import :toml;
export import :validation;
import candela.plugins;
import candela.util;

export namespace candela {

/// All files that a scene consists of or names: its own, its includes, its environment, and every parameter
/// that is a file. Absolute paths.
CANDELA_EXPORT std::vector<std::filesystem::path> input_files(const SceneDraft& draft);

/// The frames of a scene; one that is not animated has one. One thread.
class CANDELA_EXPORT SceneFrames {
  public:
    /// Reads and merges the files, and reads and validates what is animated. Reports all problems; returns
    /// nothing if a file cannot be read as TOML. `registry` must outlive the frames.
    static std::optional<SceneFrames> read(const SceneRequest& request, Registry& registry,
                                           Diagnostics& diagnostics);
    SceneFrames(SceneFrames&&) noexcept;
    SceneFrames& operator=(SceneFrames&&) noexcept;
    ~SceneFrames();

    /// Nothing if the scene is not animated, or if its animation has errors.
    const std::optional<Animation>& animation() const;
    int count() const;
    /// Whether the animation has errors; frames then ignore it.
    bool is_broken() const;

    /// Validates a frame and reports all its problems. Throws Error (bad_request) if there is no such frame.
    SceneDraft draft(int frame, Diagnostics& diagnostics);

  private:
    struct Content;
    explicit SceneFrames(std::unique_ptr<Content> content);
    std::unique_ptr<Content> content_;
};

/// Reads, merges and validates the requested frame. Reports all problems; returns nothing if a file cannot be
/// read as TOML. Throws Error (bad_request) if there is no such frame.
CANDELA_EXPORT std::optional<SceneDraft> draft_scene(const SceneRequest& request, Registry& registry,
                                                     Diagnostics& diagnostics);

/// Like draft_scene(), but returns the scene only if there was nothing worse than warnings.
CANDELA_EXPORT std::optional<Scene> read_scene(const SceneRequest& request, Registry& registry,
                                               Diagnostics& diagnostics);

/// A scene as one file, which reads back as the same scene: all defaults filled in, absolute paths. Throws
/// Error (failure) if the format cannot express a scene that did not come from a file: texts that are not
/// UTF-8, fractional colours, nameless objects with another number than their index, shading parameters that
/// differ between objects.
CANDELA_EXPORT std::string scene_text(const Scene& scene);

/// The built-in scene: one cube, one point light in the centre of the room, Phong shading, Phong reflection
/// (R12, R14).
CANDELA_EXPORT std::string_view default_scene_text() noexcept;

}  // namespace candela
