// A scene: read from files, checked, immutable.
module;

#include "candela/api.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>

export module candela.scene;

export import :content;
export import :request;
export import :schema;
import candela.diagnostics;
import candela.registry;

export namespace candela {

/// A scene as far as it was understood, so that what remains can be checked, too.
struct SceneDraft {
    Scene scene;  // without the lights and objects in which there were errors
    bool has_room = true;
    bool has_observer = true;
    bool is_complete = true;  // there were no errors
};

/// Reads, merges and checks. Reports all that is wrong; returns nothing where a file cannot be read as TOML.
CANDELA_API std::optional<SceneDraft> draft_scene(const SceneRequest& request, Registry& registry,
                                                  Diagnostics& diagnostics);

/// The same; returns the scene if nothing but warnings were found.
CANDELA_API std::optional<Scene> read_scene(const SceneRequest& request, Registry& registry,
                                            Diagnostics& diagnostics);

/// A scene as one file; read again, it is the same scene. All that a scene holds is said, defaults too, and
/// the paths of files are absolute. Throws Error (failure) where the format has no words for a scene that no
/// file has brought about: texts that are not UTF-8, colours between whole numbers, labels that are no names
/// in quotes, parameters of shading models that differ from object to object.
CANDELA_API std::string scene_text(const Scene& scene);

/// The built-in scene: one cube, one point light in the centre of the room, Phong shading, Phong reflection
/// (R12, R14).
CANDELA_API std::string_view default_scene_text() noexcept;

}  // namespace candela
