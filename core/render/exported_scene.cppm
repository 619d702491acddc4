// A validated scene as targets see it, and the files that they make of it.
module;

#include "candela/plugin/export.h"

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

export module candela.render:exported_scene;

export import candela.api;
import candela.plugins;
import candela.scene;

export namespace candela {

/// Models to switch to, in addition to those of the scene: names of reflection or shading models ("phong" is
/// both), ids such as "shading/flat", or "all", which means all that the target supports.
using ExtraModels = std::vector<std::string>;

/// The scene with all its objects switched to that shading or reflection model, or nothing if that would be
/// invalid.
using WithModel = std::function<std::optional<Scene>(PluginKind kind, const std::string& name)>;

/// A request for an export.
struct ExportRequest {
    std::string title{};
    TargetAbilities abilities{};  // the target's
    ExtraModels extra_models{};
    WithModel with_model{};  // if empty, extra models have their defaults
};

/// An ExportedScene and all its memory.
class CANDELA_EXPORT SceneExport {
  public:
    /// Loads the plugins of `scene`. Throws Error if the target cannot express it, and (usage) if an extra
    /// model is unknown. `registry` must outlive this.
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

/// The files that a target makes of a scene.
struct ExportedProgram {
    std::vector<ExportedFile> files;
    std::vector<std::string> approximations;  // what it expresses only approximately: FileSink::approximate()
};

/// Throws Error that names the target if write() throws, or if a file's name leads outside the folder or
/// occurs twice. `name`: the target's.
CANDELA_EXPORT ExportedProgram program_of(const Target& target, const std::string& name,
                                          const ExportedScene& scene);

/// Runs programs as this process's user.
class CANDELA_EXPORT SystemPrograms final : public ProgramRunner {
  public:
    bool has(const char* program) override;
    ProgramResult run(std::span<const char* const> words) override;
    int show(std::span<const char* const> words) override;

  private:
    std::string out_, err_;
};

}  // namespace candela
