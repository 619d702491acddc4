module;

#include "candela/plugin/export.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

export module candela.render:render_scene;

import candela.geometry;
import candela.plugins;
import candela.raster;
import candela.scene;
import candela.shading;
import candela.util;

export namespace candela {

/// An object with its triangles and its models.
struct RenderObject {
    std::string label;
    Mesh mesh;
    SurfaceModels surface;
    bool receives_shadows = true;
    std::optional<TriangleTree> tree{};  // of the mesh, if the reflection model shows its surroundings
};

/// A scene with its plugins loaded and its objects tessellated, shared by all its pictures. Rendering does
/// not change it. Between pictures, its observer, lights, colours and models may be replaced freely (a
/// reflection model that shows its surroundings needs its object's tree).
struct RenderScene {
    Observer observer;
    ImageSettings image;
    EnvironmentMap environment;  // visible where there is no object
    std::vector<RenderLight> lights;
    std::vector<RenderObject> objects;
    std::optional<OcclusionTree> occlusion{};  // of the objects' meshes; empty: light is not blocked
    ShadowPattern shadow_pattern = ShadowPattern::varied;
};

/// The observer's camera for a picture of that size.
CANDELA_EXPORT Camera camera_of(const Observer& observer, int width, int height);

/// Receives the progress of some work.
using Progress = std::function<void(std::size_t done, std::size_t all)>;

/// Loads only what the scene names, tessellates its objects and checks the constraints that depend on
/// triangles. Reports failures with the light or object concerned and returns nothing, also if errors were
/// reported before; warns about meshes that are not closed. `threads`: as in RenderOptions. `progress` is
/// called by one thread at a time: each object counts when it has its triangles (a large one in parts), when
/// it has been checked and when it has its normals.
CANDELA_EXPORT std::optional<RenderScene> build(const SceneDraft& draft, Registry& registry,
                                                Diagnostics& diagnostics, int threads = 0,
                                                const Progress& progress = {});
CANDELA_EXPORT std::optional<RenderScene> build(const Scene& scene, Registry& registry,
                                                Diagnostics& diagnostics, int threads = 0);

}  // namespace candela
