module;

#include "candela/plugin/export.h"

#include <memory>
#include <span>
#include <string>

export module candela.shading:surface;

import :environment_map;
import :texture;
import candela.api;
import candela.geometry;
import candela.raster;
import candela.scene;

export namespace candela {

/// A light, and the plugin it comes from.
struct RenderLight {
    std::string plugin;
    std::unique_ptr<Light> light;
};

/// The appearance of an object's surface.
struct SurfaceModels {
    Rgb color;
    std::shared_ptr<const MipMap> color_texture{};  // multiplies the colour; null: none
    TextureWrap color_texture_wrap = TextureWrap::repeat;
    std::string shading_plugin;
    std::unique_ptr<ShadingModel> shading;
    std::string reflection_plugin;
    std::unique_ptr<ReflectionModel> reflection;

    PointNeeds needs() const;
};

/// The inside of an object, for a transparent model.
struct Interior {
    const Mesh* mesh = nullptr;
    const TriangleTree* tree =
        nullptr;  // of that mesh; null: light that enters does not meet the object again
};

/// The lights of a scene, and the view of it.
struct LightingContext {
    std::span<const RenderLight> lights;
    const EnvironmentMap* environment = nullptr;  // null: transparent objects show no surroundings
    Camera camera;
};

}  // namespace candela
