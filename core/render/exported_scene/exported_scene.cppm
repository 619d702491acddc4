// A checked scene as targets see it, and the files that they make of it.
module;

#include "candela/api.h"

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

export module candela.exported_scene;

export import candela.target;
import candela.registry;
import candela.scene;

export namespace candela {

/// Models to switch to beside those of the scene: names of reflection or shading models ("phong" is both),
/// ids such as "shading/flat", or "all", those that the target can use.
using ExtraModels = std::vector<std::string>;

/// The scene as it would be if all its objects had that shading or reflection model, or nothing where it
/// would not be valid.
using WithModel = std::function<std::optional<Scene>(PluginKind kind, const std::string& name)>;

/// What a scene is to become.
struct ExportRequest {
    std::string title{};
    TargetAbilities abilities{};  // the target's
    ExtraModels extra_models{};
    WithModel with_model{};  // empty: extra models have their defaults
};

/// An ExportedScene and all its memory.
class CANDELA_API SceneExport {
  public:
    /// Loads the plugins of `scene`. Throws Error where the target is not able to express it, and (usage)
    /// where an extra model is not known. `registry` is used as long as this lives.
    SceneExport(const Scene& scene, const ExportRequest& request, Registry& registry);
    SceneExport(SceneExport&&) noexcept;
    SceneExport& operator=(SceneExport&&) noexcept;
    ~SceneExport();

    const ExportedScene& scene() const noexcept;

  private:
    struct Storage;
    std::unique_ptr<Storage> storage_;
};

struct ExportedFile {
    std::string name;  // relative; without ".."
    std::string content;
};

/// What a target makes of a scene.
struct ExportedProgram {
    std::vector<ExportedFile> files;
    std::vector<std::string> approximations;  // what it does not express exactly: FileSink::approximate()
};

/// Throws Error that names the target for what write() throws, for a file's name that leads elsewhere, and
/// for one that is written twice. `name`: the target's.
CANDELA_API ExportedProgram program_of(const Target& target, const std::string& name,
                                       const ExportedScene& scene);

/// Runs programs as this process's user.
class CANDELA_API SystemPrograms final : public ProgramRunner {
  public:
    bool has(const char* program) override;
    ProgramResult run(std::span<const char* const> words) override;
    int show(std::span<const char* const> words) override;

  private:
    std::string out_, err_;
};

}  // namespace candela
