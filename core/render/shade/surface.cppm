module;

#include "candela/api.h"

#include <memory>
#include <span>
#include <string>

export module candela.shade:surface;

import candela.color;
import candela.environment;
import candela.fragments;
import candela.geometry;
import candela.light;
import candela.mesh;
import candela.raster;
import candela.reflection;
import candela.shading;

export namespace candela {

/// A light that shines, and the plugin that it comes from.
struct LitSource {
    std::string plugin;
    std::unique_ptr<Light> light;
};

/// How an object's surface looks.
struct SurfaceModels {
    Rgb color;
    std::string shading_plugin;
    std::unique_ptr<ShadingModel> shading;
    std::string reflection_plugin;
    std::unique_ptr<ReflectionModel> reflection;

    PointNeeds needs() const;
};

/// An object's inside, for a model that light goes through.
struct Interior {
    const Mesh* mesh = nullptr;
    const TriangleTree* tree =
        nullptr;  // of that mesh; null: light that enters does not meet the object again
};

/// What shines on a scene, and from where it is looked at.
struct LitScene {
    std::span<const LitSource> lights;
    const Environment* environment = nullptr;
    Camera camera;
};

}  // namespace candela
