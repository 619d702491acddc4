module;

#include "candela/api.h"

#include <optional>
#include <string>
#include <vector>

export module candela.render:compiled_scene;

import candela.diagnostics;
import candela.environment;
import candela.geometry;
import candela.mesh;
import candela.registry;
import candela.scene;
import candela.shade;

export namespace candela {

/// An object with its triangles and its models.
struct SolidObject {
    std::string label;
    Mesh mesh;
    SurfaceModels surface;
    std::optional<TriangleTree> tree{};  // of the mesh, where the reflection model shows its surroundings
};

/// A scene with its plugins loaded and its objects tessellated: what is the same for every picture of it. Not
/// changed by rendering; between pictures its observer, lights, colours and models may be replaced at will
/// (one that shows its surroundings wants its object's tree).
struct CompiledScene {
    Observer observer;
    ImageSettings image;
    Environment environment;  // what is seen where there is no object
    std::vector<LitSource> lights;
    std::vector<SolidObject> objects;
};

/// Loads what the scene names, and nothing else, tessellates its objects and checks what only triangles can
/// tell. Reports what fails, with the light or object that wanted it, and returns nothing then, or where
/// errors were reported before; reports meshes that are not closed. `threads`: as in RenderOptions.
CANDELA_API std::optional<CompiledScene> compile(const SceneDraft& draft, Registry& registry,
                                                 Diagnostics& diagnostics, int threads = 0);
CANDELA_API std::optional<CompiledScene> compile(const Scene& scene, Registry& registry,
                                                 Diagnostics& diagnostics, int threads = 0);

}  // namespace candela
