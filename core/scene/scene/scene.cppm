// A scene: read from files, validated, immutable.
module;

#include "candela/api.h"

#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

export module candela.scene;

export import :content;
export import :request;
export import :schema;
import candela.diagnostics;
import candela.registry;

export namespace candela {

/// A scene as far as it was understood, so that the rest can be checked as well.
struct SceneDraft {
    Scene scene;  // without the lights and objects whose kind, shape or place is unknown
    bool has_room = true;
    bool has_observer = true;                    // its position is known
    bool is_complete = true;                     // there were no errors
    SourcePlace picture_place{};                 // of what says how large the picture is
    std::vector<std::filesystem::path> files{};  // all that were read, as absolute paths
};

/// All files that a scene consists of or names: itself, its includes, its environment, and every parameter
/// that is a file. Absolute paths.
CANDELA_API std::vector<std::filesystem::path> input_files(const SceneDraft& draft);

/// Reads, merges and validates. Reports all problems; returns nothing if a file cannot be read as TOML.
CANDELA_API std::optional<SceneDraft> draft_scene(const SceneRequest& request, Registry& registry,
                                                  Diagnostics& diagnostics);

/// Same, but returns the scene only if nothing worse than warnings was found.
CANDELA_API std::optional<Scene> read_scene(const SceneRequest& request, Registry& registry,
                                            Diagnostics& diagnostics);

/// A scene as one file, which reads back as the same scene: all defaults filled in, absolute paths. Throws
/// Error (failure) if the format cannot express a scene that did not come from a file: texts that are not
/// UTF-8, fractional colours, labels that are not quoted names, shading parameters that differ between
/// objects.
CANDELA_API std::string scene_text(const Scene& scene);

/// The texts of a scene's files with `changes` written into them, by path, of those that differ: values are
/// replaced where they stand or added to their tables; comments, order and everything else stay. The files
/// are not touched. Reports what is wrong with the scene or the changes, and then returns nothing. Throws
/// Error (bad_request) if a file that has the changes would not make the scene that `request` with them in
/// its settings is: if a setting or an object's own model prevails, for one.
CANDELA_API std::map<std::filesystem::path, std::string> edited_files(const SceneRequest& request,
                                                                      const std::vector<Setting>& changes,
                                                                      Registry& registry,
                                                                      Diagnostics& diagnostics);

/// The built-in scene: one cube, one point light in the centre of the room, Phong shading, Phong reflection
/// (R12, R14).
CANDELA_API std::string_view default_scene_text() noexcept;

}  // namespace candela
